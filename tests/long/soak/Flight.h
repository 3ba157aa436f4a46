// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ViewerRig.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osg/Group>
#include <osg/observer_ptr>

#include <map>
#include <memory>
#include <support/Random.h>

namespace osgAnalyticBin::test {

/// What a flight found at its end or on its way.
struct Findings {
    std::size_t frames = 0, stations = 0;
    std::size_t tilesLoaded = 0;  ///< PagedLODs that were seen with children in the frames that were looked at
    std::size_t differingPictures = 0, pictures = 0;
    std::size_t differingPixels = 0;
    std::size_t coveredPixels = 0;
    std::size_t strayObjects = 0;    ///< of the kit, alive at stations outside of the scene
    std::size_t undrainedTiles = 0;  ///< at stations, still loaded though out of view
    std::size_t unloaded = 0;        ///< stations at which the pager did not come to rest
};

/// The callbacks that the kit has put into a scene, told apart by address and observed until they are deleted. Not the
/// options that files are read with: OSG's PagedLODs keep those of their last request.
class KitObjects {
public:
    /// Looks for those in the scene. Returns: how many there are.
    std::size_t note(osg::Node& scene);

    /// Of all that were ever noted, those that are alive.
    [[nodiscard]] std::size_t alive();

    /// The same by class, for a message.
    [[nodiscard]] std::string kinds() const;

private:
    std::map<const osg::Object*, osg::observer_ptr<osg::Object>> _known;
};

/// Says what the main thread does from now on. Where it does not report again for 60 s, the process says on stderr what
/// it did last, prints its stack, and aborts.
void reportProgress(const std::string& what);

/// A viewer over databases, one of which stays from its beginning to its end, flown at random while everything that may
/// change does.
class Flight {
public:
    struct Setup {
        Threading threading;
        Layout layout;
        int cameras;
        bool withBins;
    };

    /// `databases`: files; the first two stay, copies of all come and go.
    Flight(const Setup& setup, const std::vector<std::string>& databases, Random& random, Findings& findings);
    ~Flight();

    /// Draws the most that the scene can ever hold, in every threading model: what OpenSceneGraph's visitors keep from
    /// frame to frame has its full size afterwards, and all that can be known of false databases is known.
    void warmUp();

    /// Flies that many frames; every change may happen in each.
    void fly(std::size_t frames);

    /// Compares the picture with that without culling, then returns to a state that is the same at every station: the
    /// databases that stay, default options, nothing paged in.
    void halt();

private:
    class Pictures;

    void frame();
    void change();
    void changeOptions();
    void changeDatabases();
    void changeThreads();
    void lookAround();
    void addDatabase(const std::string& file);
    bool rest();
    void comparePictures();
    void drain();
    void report(const char* what);

    const Setup _setup;
    const std::vector<std::string>& _databases;
    Random& _random;
    Findings& _findings;
    const osg::ref_ptr<osg::Group> _scene = new osg::Group;
    std::unique_ptr<ViewerRig> _rig;
    std::unique_ptr<Pictures> _pictures;
    KitObjects _objects;
    double _time = 0.0;
    double _latitude = 0.0, _longitude = 0.0, _altitude = 1e6, _heading = 0.0, _pitch = 30.0;
};

}  // namespace osgAnalyticBin::test
