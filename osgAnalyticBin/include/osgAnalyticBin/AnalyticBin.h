// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <osg/BoundingSphere>
#include <osg/Vec3d>

#include <optional>
#include <string>

namespace osg {
class EllipsoidModel;
class Node;
}  // namespace osg

namespace osgAnalyticBin {

/// The bounding volume of a terrain tile, in the manner of osg::BoundingBox: a box in latitude, longitude and
/// altitude, a margin in metres by which drawn geometry may leave the box (the rounding of float vertices), and the sag
/// in metres by which meshes and their skirts dip below posts. The box includes the sag; a vertical scale does not
/// change the sag. Units: radians and metres; degrees only in text. A default-constructed bin is empty, that is, not
/// valid().
class OSGANALYTICBIN_EXPORT AnalyticBin {
public:
    AnalyticBin() = default;
    /// A bin of this box. `margin`: metres.
    explicit AnalyticBin(const core::GeodeticBin& bin, double margin = 0.0) : _bin(bin), _margin(margin) {}

    /// Makes the bin empty.
    void init() { *this = AnalyticBin(); }

    /// Whether the bin has a box. An invalid bin means "not known" and is never culled.
    [[nodiscard]] bool valid() const { return !_bin.empty(); }

    /// The box: with the sag, without the margin.
    [[nodiscard]] const core::GeodeticBin& bin() const { return _bin; }
    /// Replaces the box alone; margin and sag stay.
    void setBin(const core::GeodeticBin& bin) { _bin = bin; }

    /// Metres, default 0.
    [[nodiscard]] double margin() const { return _margin; }
    /// Metres, 0 or more.
    void setMargin(double margin) { _margin = margin; }

    /// Metres, default 0: the part of the box's depth that is due to chords between posts and to skirts, not to
    /// heights.
    [[nodiscard]] double sag() const { return _sag; }
    /// Metres, 0 or more.
    void setSag(double sag) { _sag = sag; }

    /// Grows the box to hold a position; margin and sag stay.
    void expandBy(const core::Geodetic& position) { _bin.expandBy(position); }
    /// Grows to hold all that the other bin holds; margin and sag become the larger of both.
    void expandBy(const AnalyticBin& other);

    /// Whether the position is in the box, without the margin.
    [[nodiscard]] bool contains(const core::Geodetic& position) const { return _bin.contains(position); }
    /// Whether the other's box is in this one, and its margin and sag are no larger; every bin contains an invalid one.
    [[nodiscard]] bool contains(const AnalyticBin& other) const;

    /// Whether box, margin and sag are the same numbers.
    [[nodiscard]] bool operator==(const AnalyticBin& other) const {
        return _bin == other._bin && _margin == other._margin && _sag == other._sag;
    }
    /// Whether anything differs.
    [[nodiscard]] bool operator!=(const AnalyticBin& other) const { return !(*this == other); }

    /// The bin of the same terrain with all heights multiplied, as osgTerrain::Terrain::setVerticalScale() does.
    /// Any scale is allowed; not valid() when it is not finite.
    /// Guarantee: holds every mesh of the scaled posts that the bin holds unscaled; tests: AnalyticBin.Exaggeration*.
    /// Source: doc/theory/tiles.md, section 3.
    [[nodiscard]] AnalyticBin exaggerated(double verticalScale) const;

    /// The bin of the same terrain with skirts that hang down so many metres. They count as sag: their length does not
    /// grow with a vertical scale. Of a bin that is not valid(): the same.
    [[nodiscard]] AnalyticBin withSkirts(double metres) const;

    /// The middle of the bin in ECEF metres. Requires: valid().
    [[nodiscard]] osg::Vec3d center(const osg::EllipsoidModel& ellipsoid) const;

    /// A sphere, rounded outward to float, that holds the mapped bin with its margin; invalid when the bin is.
    [[nodiscard]] osg::BoundingSphere boundingSphere(const osg::EllipsoidModel& ellipsoid) const;

    /// "south west low north east high margin": degrees and metres, separated by blanks, readable in text files. An
    /// eighth number is the sag; it is left out when it is 0.
    /// Guarantee: fromText(toText()) holds this bin, and equals it bit for bit when it was made from degrees;
    /// tests: AnalyticBin.TextRoundTrip*.
    [[nodiscard]] std::string toText() const;

    /// Returns: an invalid bin when the text is not seven or eight finite numbers in order and range.
    [[nodiscard]] static AnalyticBin fromText(const std::string& text);

private:
    core::GeodeticBin _bin;
    double _margin = 0.0;
    double _sag = 0.0;
};

/// Stores a bin with a node as the string user value "osgAnalyticBin". This is a type of OSG's own, so OSG without this
/// library reads such files without a warning.
OSGANALYTICBIN_EXPORT void setStoredBin(osg::Node& node, const AnalyticBin& bin);

/// Returns: the stored bin; an invalid one, after a warning, when the stored text is broken; an invalid one when there
/// is none.
[[nodiscard]] OSGANALYTICBIN_EXPORT AnalyticBin storedBin(const osg::Node& node);

/// Returns: whether the node has a stored bin, valid or broken.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool hasStoredBin(const osg::Node& node);

/// Stores a lower bound in metres of the altitudes of the tile's own surface, without descendants and skirts, as the
/// user value "osgAnalyticBin.surfaceLow". The horizon is tested against the surfaces that are shown.
OSGANALYTICBIN_EXPORT void setStoredSurfaceLow(osg::Node& node, double metres);

/// Metres. Returns: nullopt when there is none, and, after a warning, when it is broken.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::optional<double> storedSurfaceLow(const osg::Node& node);

}  // namespace osgAnalyticBin
