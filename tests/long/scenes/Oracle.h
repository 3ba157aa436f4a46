// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is compared of a scene with bins and without, and what may differ.

#pragma once

#include "Description.h"
#include "Recorder.h"

namespace osgAnalyticBin::test {

/// The line of sight to a point, in eye space: from the near plane.
struct Sight {
    osg::Vec3d start, end, inPicture;
    bool isPerspective;  ///< the eye is at the origin
};

/// A database of which the documentation says that something hidden below it may be culled, though no face that is
/// drawn hides it. It hides where the near plane has cut its faces away; the flags say where else. It is as large as
/// the kit may take it to be: the ellipsoid, or what is lower than the eye.
struct AllowedOccluder {
    int database = 0;
    /// Metres above the ellipsoid: above it, an eye sees the database's faces from in front.
    double highest = 0.0;
    bool fromBelow = false;       ///< from eyes below the highest terrain
    bool fromEverywhere = false;  ///< from all eyes
};

/// What the documentation excludes of a scene.
[[nodiscard]] std::vector<AllowedOccluder> allowedOccluders(const Description& description);

/// Whether the occluder, where a traversal met its database, may hide the end of a line of sight.
[[nodiscard]] bool mayHide(const AllowedOccluder& occluder, const Description& description, const MetDatabase& met,
                           const Sight& sight);

using Triangle = std::array<osg::Vec3d, 3>;

/// The triangles of a drawable in another frame.
struct Triangles {
    std::vector<Triangle> surface;
    std::vector<Triangle> skirts;  ///< of strips
    osg::Vec3d center;
    double radius = -1.0;

    Triangles(const osg::Drawable& drawable, const osg::Matrixd& matrix);

    /// Whether one of them is met strictly between the ends of a segment.
    [[nodiscard]] bool block(const osg::Vec3d& from, const osg::Vec3d& to) const;
};

/// What a drawable was lost to.
struct FalseCull {
    std::string key;
    osg::Vec3d pointInEyeSpace;
    osg::Vec3d pointInPicture;
};

/// What may be culled although it is in the picture.
struct WhatCounts {
    double smallestPixels = 0.0;          ///< drawables that are smaller may be
    bool onlyBetweenGivenPlanes = false;  ///< near and far planes cull, before they are computed
};

/// Looks for a point of a drawable that one traversal delivered and the other did not, that is in the picture and
/// behind nothing that is drawn.
[[nodiscard]] std::optional<FalseCull> findFalseCull(const Description& description, const Delivery& without,
                                                     const Delivery& with, const std::vector<AllowedOccluder>& allowed,
                                                     const WhatCounts& counts);

/// A pixel that differs, and how many do.
struct PictureDifference {
    std::string without;  ///< key of the drawable in it, and the point in eye space
    std::string with;
    int column = 0, row = 0;
    std::size_t pixels = 0;
};

/// Totals of the comparisons of pictures.
struct PictureTotals {
    std::size_t pictures = 0;
    std::size_t covered = 0;  ///< pixels with something in them
    std::size_t allowed = 0;  ///< pixels that differ where the documentation says that they may
};

/// The scene with what cannot be pictured taken out of its views: near and far planes that are computed of what is
/// drawn, and so differ with bins, and small features that are culled though they have a pixel. Without clip planes, as
/// OSG places one by the matrix of whatever is drawn first below its state, without primitive restart, as display lists
/// keep what was in force when they were made, and without rasterizer discard, with which OpenGL does not clear the
/// buffers of the next camera either.
[[nodiscard]] Description picturable(Description description);

/// Compares the paintings of two deliveries, pixel for pixel. Returns: the first difference that is not allowed.
[[nodiscard]] std::optional<PictureDifference> findPictureDifference(const Description& description,
                                                                     const Painter& painter, const Delivery& without,
                                                                     const Delivery& with,
                                                                     const std::vector<AllowedOccluder>& allowed,
                                                                     PictureTotals& totals);

/// What a line meets in a scene.
struct Picked {
    std::vector<std::string> hits;  ///< the nodes on the way to each, and where it is
    std::size_t visited = 0;        ///< nodes
};

[[nodiscard]] Picked pick(osg::Node& scene, const osg::Vec3d& from, const osg::Vec3d& to);

/// Compares picks with bins and without. `comparesVisits`: else hits alone. Returns: what is wrong.
[[nodiscard]] std::optional<std::string> findPickDifference(const Picked& without, const Picked& with,
                                                            bool comparesVisits);

/// How two nodes differ.
struct Difference {
    std::string what;
    std::string text;
};

/// Compares a scene that never had bins with one that they were taken off again: culling flags, callbacks, user values,
/// expiry times and structure. Both may have been saved and read.
/// Returns: the first difference, in this order of kinds; nullopt when the scenes are the same.
[[nodiscard]] std::optional<Difference> findDifference(osg::Node& without, osg::Node& with, bool wereSaved);

}  // namespace osgAnalyticBin::test
