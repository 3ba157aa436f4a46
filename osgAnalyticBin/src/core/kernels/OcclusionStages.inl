// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The loops of OcclusionKernels.h. The lanes are cells of a tile, corners of a body, or strips of the picture. Formulas
// and bounds of their rounding: doc/theory/occlusion.md, sections 2 to 4.
// Included behind a namespace's numbers.

template <class Real>
struct Triple {
    Real x, y, z;
};

// The sine and the cosine of an angle of at most kFarthestFromMiddle: Taylor's series, whose next terms are below a
// quarter of kEpsilon.
template <class Real>
struct SmallAngle {
    INLINE explicit SmallAngle(Real angle) {
        const Real square = angle * angle;
        const auto series = [&](Real sum, double term) ATTRIBUTES { return sum * square + broadcast<Real>(term); };
        Real odd = broadcast<Real>(1.0 / 6227020800.0), even = broadcast<Real>(-1.0 / 87178291200.0);
        odd = series(odd, -1.0 / 39916800.0);
        odd = series(odd, 1.0 / 362880.0);
        odd = series(odd, -1.0 / 5040.0);
        odd = series(odd, 1.0 / 120.0);
        odd = series(odd, -1.0 / 6.0);
        even = series(even, 1.0 / 479001600.0);
        even = series(even, -1.0 / 3628800.0);
        even = series(even, 1.0 / 40320.0);
        even = series(even, -1.0 / 720.0);
        even = series(even, 1.0 / 24.0);
        even = series(even, -0.5);
        sine = angle + angle * (square * odd);
        cosine = broadcast<Real>(1.0) + square * even;
    }
    Real sine, cosine;
};

// The sine and the cosine of a sum.
template <class Real>
struct Direction {
    INLINE Direction(double sinMiddle, double cosMiddle, Real angle) {
        const SmallAngle<Real> small(angle);
        sine = broadcast<Real>(sinMiddle) * small.cosine + broadcast<Real>(cosMiddle) * small.sine;
        cosine = broadcast<Real>(cosMiddle) * small.cosine - broadcast<Real>(sinMiddle) * small.sine;
    }
    Real sine, cosine;
};

// One side of cells in longitude: along the axes of the eye's frame, the direction from the globe's axis; in a plane,
// how far the side is from x = 0.
template <class Real>
struct Meridian {
    INLINE Meridian(const CellGround& ground, Real share) {
        const Real angle = broadcast<Real>(ground.width) * share;
        if (ground.isPlane) {
            const Real x = broadcast<Real>(ground.radius) * (broadcast<Real>(ground.longitude) + angle);
            at = {x * broadcast<Real>(ground.x[0]), x * broadcast<Real>(ground.x[1]), x * broadcast<Real>(ground.x[2])};
            return;
        }
        const Direction<Real> d(ground.sinLongitude, ground.cosLongitude, angle);
        const auto along = [&](int axis) ATTRIBUTES {
            return broadcast<Real>(ground.x[axis]) * d.cosine + broadcast<Real>(ground.y[axis]) * d.sine;
        };
        at = {along(0), along(1), along(2)};
    }
    Triple<Real> at;
};

// Points of one latitude and altitude: [DERIVATION] section 1, ECEF of a geodetic position is
// rho (cos l, sin l, 0) + z (0, 0, 1).
template <class Real>
struct Ring {
    Real axisDistance;
    Triple<Real> middle;  // on the globe's axis, from the eye; in a plane, where x is 0

    INLINE Triple<Real> at(const Meridian<Real>& meridian) const {
        return {axisDistance * meridian.at.x + middle.x, axisDistance * meridian.at.y + middle.y,
                axisDistance * meridian.at.z + middle.z};
    }
};

// One side of cells in latitude.
template <class Real>
struct Parallel {
    INLINE Parallel(const CellGround& tile, Real share) : ground(tile) {
        const Real angle = broadcast<Real>(ground.height) * share;
        if (ground.isPlane) {
            radius = broadcast<Real>(ground.radius) * (broadcast<Real>(ground.latitude) + angle);
            return;
        }
        const Direction<Real> d(ground.sinLatitude, ground.cosLatitude, angle);
        sine = d.sine, cosine = d.cosine;
        const Real w = cosine * cosine + broadcast<Real>(ground.squaredRatio) * (sine * sine);
        radius = broadcast<Real>(ground.radius) / root(w);
    }
    INLINE Ring<Real> ring(Real altitude) const {
        const auto isPlane = ground.isPlane;
        const Real z = isPlane ? altitude : (broadcast<Real>(ground.squaredRatio) * radius + altitude) * sine;
        const auto middle = [&](int axis) ATTRIBUTES {
            const Real fromPlane = z * broadcast<Real>(ground.z[axis]) - broadcast<Real>(ground.eye[axis]);
            return isPlane ? radius * broadcast<Real>(ground.y[axis]) + fromPlane : fromPlane;
        };
        return {isPlane ? broadcast<Real>(1.0) : (radius + altitude) * cosine, {middle(0), middle(1), middle(2)}};
    }
    const CellGround& ground;
    Real radius;  // of curvature across the meridian; in a plane, y
    Real sine, cosine;
};

// Where the numbers of some columns go, corner by corner.
template <class Real>
struct CornerRows {
    double* to;
    std::size_t stride;

    INLINE void put(const Triple<Real>& corner) {
        store(corner.x, to);
        store(corner.y, to + stride);
        store(corner.z, to + 2 * stride);
        to += 3 * stride;
    }
    INLINE void putFour(const Ring<Real>& southern, const Ring<Real>& northern, const Meridian<Real>& west,
                        const Meridian<Real>& east) {
        put(southern.at(west));
        put(southern.at(east));
        put(northern.at(west));
        put(northern.at(east));
    }
};

template <class Real>
INLINE void columnsOf(const CellGround& ground, const CellRows& cells, double* corners, std::size_t stride) {
    for (std::size_t first = 0; first < cells.count; first += lanesOf<Real>()) {
        const Meridian<Real> west(ground, load<Real>(cells.west + first)), east(ground, load<Real>(cells.east + first));
        const Parallel<Real> south(ground, load<Real>(cells.south + first)),
            north(ground, load<Real>(cells.north + first));
        const Real high = load<Real>(cells.high + first), low = high - broadcast<Real>(ground.depth);
        CornerRows<Real> rows{corners + first, stride};
        rows.putFour(south.ring(high), north.ring(high), west, east);
        rows.putFour(south.ring(low), north.ring(low), west, east);
    }
}

// The rounding of a vector from the eye, in units of the longest vector from the centre.
constexpr double kVectorRounding = 16.0 * kEpsilon;

// A position in the picture, or its error.
template <class Real>
struct Spot {
    Real x, y;
};

// The error of a position in the picture, for a point that is wrong by up to `x`, `y` and `z` metres along the axes;
// doc/theory/occlusion.md, section 4. `spot`: how far the position is from the middle of the picture, at most.
template <class Real>
INLINE Spot<Real> pictureError(const Triple<Real>& metres, Real forward, const Spot<Real>& spot) {
    const Real one = broadcast<Real>(1.0), rounding = broadcast<Real>(16.0 * kEpsilon);
    const Real inverse = one / (forward - metres.y);
    return {(metres.x + spot.x * metres.y) * inverse + rounding * (one + spot.x),
            (metres.z + spot.y * metres.y) * inverse + rounding * (one + spot.y)};
}

template <class Real>
INLINE Triple<Real> eyesAnd(const PictureData& picture, Real reach) {
    return {broadcast<Real>(picture.eyes[0]) + reach, broadcast<Real>(picture.eyes[1]) + reach,
            broadcast<Real>(picture.eyes[2]) + reach};
}

// Pictures of corners, and bounds of them all.
template <class Real>
struct Corners {
    Real nearest = broadcast<Real>(kInfinity), farthest = broadcast<Real>(0.0);
    Spot<Real> largest{broadcast<Real>(0.0), broadcast<Real>(0.0)};
    Truth<Real> haveSpots;

    INLINE explicit Corners(Truth<Real> all) : haveSpots(all) {}
    INLINE Spot<Real> add(const Triple<Real>& corner) {
        const Real inverse = broadcast<Real>(1.0) / corner.y;
        const Spot<Real> spot{corner.x * inverse, corner.z * inverse};
        nearest = smaller(nearest, corner.y);
        farthest = larger(farthest, corner.y);
        const Spot<Real> size{magnitude(spot.x), magnitude(spot.y)};
        largest = {larger(largest.x, size.x), larger(largest.y, size.y)};
        // written so that NaN is left out; rays near the picture's plane would make positions as large as one likes
        const Real steepest = broadcast<Real>(1e3);
        haveSpots = both(both(haveSpots, corner.y > broadcast<Real>(0.0)), both(size.x < steepest, size.y < steepest));
        return spot;
    }
};

// A line through two points that may be elsewhere by `error`, no lower than the true one (`side` 1) or no higher (-1):
// y = slope x + offset. doc/theory/occlusion.md, section 4.
template <class Real>
struct Line {
    INLINE Line(const Spot<Real>& a, const Spot<Real>& b, double side, const Spot<Real>& error) {
        const Real one = broadcast<Real>(1.0);
        slope = (b.y - a.y) / (b.x - a.x);
        const Real steepness = magnitude(slope);
        const Real rounding =
            broadcast<Real>(16.0 * kEpsilon) * (steepness * (one + magnitude(a.x)) + one + magnitude(a.y));
        offset = a.y - slope * a.x + broadcast<Real>(side) * (error.y + steepness * error.x + rounding);
    }
    Real slope, offset;
};

// A corner of a column's top, and the one below it.
template <class Real>
struct End {
    Spot<Real> top;
    Triple<Real> below;

    INLINE void choose(Truth<Real> where, const End& other) {
        top = {select(where, other.top.x, top.x), select(where, other.top.y, top.y)};
        below = {select(where, other.below.x, below.x), select(where, other.below.y, below.y),
                 select(where, other.below.z, below.z)};
    }
};

template <class Real>
INLINE Walls wallsOf(const PictureData& picture, const ColumnRows& columns, double* walls) {
    Real nearest2 = broadcast<Real>(kInfinity);
    std::uint64_t bits = 0;
    for (std::size_t first = 0; first < columns.count; first += lanesOf<Real>()) {
        const auto corner = [&](std::size_t number) ATTRIBUTES {
            const double* const from = columns.corners + 3 * number * columns.stride + first;
            return Triple<Real>{load<Real>(from), load<Real>(from + columns.stride),
                                load<Real>(from + 2 * columns.stride)};
        };
        const Real error = load<Real>(columns.error + first), zero = broadcast<Real>(0.0);
        Corners<Real> corners(error >= zero);
        // Uses only a wall of the column, between its leftmost and its rightmost corner. The picture of the wall is
        // hardly smaller than that of the column, and it ends in straight lines.
        Real closest2 = broadcast<Real>(kInfinity);
        const auto end = [&](std::size_t number) ATTRIBUTES {
            const Triple<Real> v = corner(number);
            closest2 = smaller(closest2, v.x * v.x + v.y * v.y + v.z * v.z);
            return End<Real>{corners.add(v), corner(number + 4)};
        };
        End<Real> left = end(0), right = left;
        for (std::size_t number = 1; number < 4; ++number) {
            const End<Real> other = end(number);
            left.choose(other.top.x < left.top.x, other);
            right.choose(other.top.x > right.top.x, other);
        }
        const std::uint64_t there = (std::uint64_t{1} << std::min(columns.count - first, kMostLanes)) - 1;
        const Truth<Real> hasTop = both(corners.haveSpots, whereLanes<Real>(there));
        nearest2 = smaller(nearest2, select(hasTop, closest2, broadcast<Real>(kInfinity)));
        const Truth<Real> isInPicture = both(right.top.x > broadcast<Real>(picture.left),
                                             left.top.x < broadcast<Real>(picture.right));
        const Truth<Real> isWide = right.top.x - left.top.x > broadcast<Real>(picture.step);
        if (!anyWhere<Real>(both(hasTop, both(isInPicture, isWide)))) continue;
        const Spot<Real> leftBottom = corners.add(left.below), rightBottom = corners.add(right.below);
        // the length of a vector from the eye is at most forward (1 + |x| + |y|)
        const Real longest = broadcast<Real>(picture.eyeToCentre) +
                             corners.farthest * (broadcast<Real>(1.0) + corners.largest.x + corners.largest.y);
        const Real wrong = error + broadcast<Real>(kVectorRounding) * longest;
        const Triple<Real> wrongAndEyes = eyesAnd(picture, wrong);
        const Truth<Real> isFar = both(corners.nearest > broadcast<Real>(4.0) * wrong,
                                       corners.nearest > broadcast<Real>(1.5) * wrongAndEyes.y);
        const Truth<Real> isUpright = leftBottom.x < rightBottom.x;
        const Truth<Real> isWall = both(both(both(hasTop, corners.haveSpots), both(isInPicture, isWide)),
                                        both(isFar, isUpright));
        const Spot<Real> inPicture = pictureError(wrongAndEyes, corners.nearest, corners.largest);
        const Line<Real> top(left.top, right.top, -1.0, inPicture);
        const Line<Real> bottom(leftBottom, rightBottom, 1.0, inPicture);
        const auto put = [&](std::size_t row, Real number) ATTRIBUTES {
            store(number, walls + row * columns.stride + first);
        };
        put(WallRow::Farthest, corners.farthest + wrong);
        put(WallRow::Highest, larger(left.top.y, right.top.y));
        put(WallRow::From, larger(left.top.x, leftBottom.x) + inPicture.x);
        put(WallRow::To, smaller(right.top.x, rightBottom.x) - inPicture.x);
        put(WallRow::TopSlope, top.slope);
        put(WallRow::TopOffset, top.offset);
        put(WallRow::BottomSlope, bottom.slope);
        put(WallRow::BottomOffset, bottom.offset);
        bits |= laneBits<Real>(isWall) << first;
    }
    return {bits, leastLane(nearest2)};
}

// What a body's outline is made of. Corners are in the lanes.
template <class Real>
struct Body {
    INLINE explicit Body(const BodyData& data) : body(data) {}

    // The least of a number over all corners.
    template <class Number>
    INLINE double least(Number&& number) const {
        Real least = broadcast<Real>(kInfinity);
        for (std::size_t first = 0; first < kMostLanes; first += lanesOf<Real>()) {
            least = smaller(least, number(Triple<Real>{load<Real>(body.x + first), load<Real>(body.y + first),
                                                       load<Real>(body.z + first)}));
        }
        return leastLane(least);
    }
    const BodyData& body;
};

template <class Real>
INLINE void outlineOf(const PictureData& picture, const BodyData& data, OutlineData& outline) {
    const Body<Real> body(data);
    const auto length2 = [](const Triple<Real>& v) ATTRIBUTES { return v.x * v.x + v.y * v.y + v.z * v.z; };
    outline = {-kInfinity, kInfinity, -kInfinity, kInfinity, -kInfinity, body.least(length2), false};
    // NaN and infinite numbers are not below the largest number
    const double most = body.least([&](const Triple<Real>& v) ATTRIBUTES {
        const Real size = magnitude(v.x) + magnitude(v.y) + magnitude(v.z);
        return select(size <= broadcast<Real>(kLargest), negated(length2(v)), broadcast<Real>(-kInfinity));
    });
    if (!(most > -kInfinity && data.reach >= 0.0 && data.reach <= kLargest)) return;
    const double nearest = body.least([](const Triple<Real>& v) ATTRIBUTES { return v.y; });
    const double reach = data.reach + kVectorRounding * (picture.eyeToCentre + std::sqrt(-most));
    const Triple<double> reachAndEyes{picture.eyes[0] + reach, picture.eyes[1] + reach, picture.eyes[2] + reach};
    outline.nearest = nearest - reach;
    // beyond the planes through the eye and the sides of the picture
    const auto isBeyond = [&](double x, double side) ATTRIBUTES {
        const double room = 1.001 * (reachAndEyes.x + std::abs(x) * reachAndEyes.y);
        return body.least([&](const Triple<Real>& v) ATTRIBUTES {
            return broadcast<Real>(side) * (v.x - broadcast<Real>(x) * v.y);
        }) > room;
    };
    if (!(outline.nearest > picture.eyes[1])) {
        const double farthest = -body.least([](const Triple<Real>& v) ATTRIBUTES { return negated(v.y); });
        outline.isBeside =
            farthest < -reachAndEyes.y || isBeyond(picture.left, -1.0) || isBeyond(picture.right, 1.0);
        return;
    }
    Real left = broadcast<Real>(kInfinity), low = left, right = broadcast<Real>(-kInfinity), high = right;
    const Real drawing = broadcast<Real>(picture.drawing);
    const Triple<Real> metres{broadcast<Real>(reachAndEyes.x), broadcast<Real>(reachAndEyes.y),
                              broadcast<Real>(reachAndEyes.z)};
    for (std::size_t first = 0; first < kMostLanes; first += lanesOf<Real>()) {
        const Real forward = load<Real>(data.y + first), inverse = broadcast<Real>(1.0) / forward;
        const Spot<Real> spot{load<Real>(data.x + first) * inverse, load<Real>(data.z + first) * inverse};
        const Spot<Real> error = pictureError(metres, forward, Spot<Real>{magnitude(spot.x), magnitude(spot.y)});
        left = smaller(left, spot.x - (error.x + drawing));
        right = larger(right, spot.x + (error.x + drawing));
        low = smaller(low, spot.y - (error.y + drawing));
        high = larger(high, spot.y + (error.y + drawing));
    }
    outline.left = leastLane(left), outline.right = -leastLane(negated(right));
    outline.low = leastLane(low), outline.high = -leastLane(negated(high));
    outline.isBeside = outline.right < picture.left || outline.left > picture.right;
}

// Some strips one after the other. Those beside first to last - 1 do not count.
template <class Real>
struct Strips {
    INLINE Strips(std::size_t at, std::size_t first, std::size_t last) : number(load<Real>(kStripNumbers.of + at)) {
        const auto edge = [](std::size_t strip) ATTRIBUTES { return broadcast<Real>(kStripNumbers.of[strip]); };
        count = both(number >= edge(first), number < edge(last));
    }
    // Where vectors of strips begin.
    INLINE static std::size_t begin(std::size_t first) { return first / lanesOf<Real>() * lanesOf<Real>(); }
    Real number;
    Truth<Real> count;
};

template <class Real>
INLINE bool isAboveOneOf(const double* heights, std::size_t first, std::size_t last, double height) {
    for (std::size_t at = Strips<Real>::begin(first); at < last; at += lanesOf<Real>()) {
        const Truth<Real> isAbove = load<Real>(heights + at) < broadcast<Real>(height);
        if (anyWhere<Real>(both(isAbove, Strips<Real>(at, first, last).count))) return true;
    }
    return false;
}

// A wall is convex, and so is its picture: at each x the wall covers the interval between its two lines. Within a strip
// a line is lowest at one end and highest at the other.
// Where the wall's interval meets the one that is known, their union is covered. Where they do not meet, only the
// higher one is kept.
template <class Real>
INLINE void raiseStrips(const PictureData& picture, const double* wall, std::size_t first, std::size_t last,
                        double* lowerEnds, double* upperEnds) {
    const double leftEnd = picture.left, rightEnd = picture.left + picture.step;
    const Real topSlope = broadcast<Real>(wall[WallRow::TopSlope]);
    const Real topOffset = broadcast<Real>(wall[WallRow::TopOffset]);
    const Real bottomSlope = broadcast<Real>(wall[WallRow::BottomSlope]);
    const Real bottomOffset = broadcast<Real>(wall[WallRow::BottomOffset]);
    const Real topEnd = broadcast<Real>(wall[WallRow::TopSlope] < 0.0 ? rightEnd : leftEnd);
    const Real bottomEnd = broadcast<Real>(wall[WallRow::BottomSlope] < 0.0 ? leftEnd : rightEnd);
    const Real step = broadcast<Real>(picture.step);
    for (std::size_t at = Strips<Real>::begin(first); at < last; at += lanesOf<Real>()) {
        const Strips<Real> strips(at, first, last);
        const Real toRight = step * strips.number;
        const Real lower = bottomSlope * (bottomEnd + toRight) + bottomOffset;
        const Real upper = topSlope * (topEnd + toRight) + topOffset;
        const Real knownLower = load<Real>(lowerEnds + at), knownUpper = load<Real>(upperEnds + at);
        const Truth<Real> isHigher = upper > knownUpper, isWall = both(strips.count, lower <= upper);
        const Truth<Real> meet = both(lower <= knownUpper, knownLower <= upper);
        const Real joined = select(meet, smaller(lower, knownLower), select(isHigher, lower, knownLower));
        store(select(isWall, joined, knownLower), lowerEnds + at);
        store(select(both(isWall, isHigher), upper, knownUpper), upperEnds + at);
    }
}

template <class Real>
INLINE bool coversHeights(const double* lowerEnds, const double* upperEnds, std::size_t first, std::size_t last,
                          double low, double high) {
    for (std::size_t at = Strips<Real>::begin(first); at < last; at += lanesOf<Real>()) {
        const Truth<Real> isCovered = both(load<Real>(lowerEnds + at) <= broadcast<Real>(low),
                                           broadcast<Real>(high) <= load<Real>(upperEnds + at));
        if (anyWhere<Real>(without(Strips<Real>(at, first, last).count, isCovered))) return false;
    }
    return true;
}
