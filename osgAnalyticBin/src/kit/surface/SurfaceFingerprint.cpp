// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainTileSurface.h"

#include <osgAnalyticBin/TileSurface.h>

#include <osg/Billboard>
#include <osg/Geometry>

#include <cstring>

namespace osgAnalyticBin {

namespace {

std::uint64_t rotated(std::uint64_t word, int bits) {
    return (word << bits) | (word >> (64 - bits));
}

// Mixes 64-bit words that are made of values, not of bytes in memory. Every step is a bijection of its lane for a given
// word, so that one changed word always shows; the lanes are there for the processor to work on at once.
class WordMixer {
public:
    void add(std::uint64_t word) {
        _lanes[_next] = mixed(_lanes[_next], word);
        _next = (_next + 1) % kLanes;
    }

    void add(double value) { add(bitsOf<std::uint64_t>(&value)); }

    // Values of 1, 2, 4 or 8 bytes, the first of a word in its lowest bits.
    template <class Bits>
    void addArray(const void* values, std::size_t count) {
        const auto* bytes = static_cast<const unsigned char*>(values);
        add(std::uint64_t{count});
        constexpr std::size_t kPerWord = sizeof(std::uint64_t) / sizeof(Bits);
        constexpr std::size_t kPerBlock = kPerWord * kLanes;
        std::size_t i = 0;
        // in locals, which the compiler keeps in registers
        std::uint64_t lanes[kLanes];
        std::memcpy(lanes, _lanes, sizeof(lanes));
        for (; i + kPerBlock <= count; i += kPerBlock) {
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                lanes[lane] = mixed(lanes[lane], wordOf<Bits>(bytes + (i + lane * kPerWord) * sizeof(Bits), kPerWord));
        }
        std::memcpy(_lanes, lanes, sizeof(lanes));
        for (; i + kPerWord <= count; i += kPerWord) add(wordOf<Bits>(bytes + i * sizeof(Bits), kPerWord));
        if (i < count) add(wordOf<Bits>(bytes + i * sizeof(Bits), count - i));
    }

    [[nodiscard]] std::uint64_t result() const {
        std::uint64_t sum = _next;
        for (const std::uint64_t lane : _lanes) {
            sum = (sum ^ lane ^ (lane >> 29)) * kOdd;
            sum ^= sum >> 32;
        }
        return sum != 0 ? sum : 1;
    }

private:
    static constexpr std::size_t kLanes = 8;
    // 2^64 divided by the golden ratio, made odd.
    static constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;

    static std::uint64_t mixed(std::uint64_t lane, std::uint64_t word) { return rotated((lane ^ word) * kOdd, 31); }

    template <class Bits>
    static Bits bitsOf(const void* value) {
        Bits bits;
        std::memcpy(&bits, value, sizeof(bits));
        return bits;
    }

    template <class Bits>
    static std::uint64_t wordOf(const unsigned char* bytes, std::size_t count) {
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < count; ++i)
            word |= std::uint64_t{bitsOf<Bits>(bytes + i * sizeof(Bits))} << (8 * sizeof(Bits) * i);
        return word;
    }

    std::uint64_t _lanes[kLanes] = {1, 2, 3, 4, 5, 6, 7, 8};
    std::size_t _next = 0;
};

class FingerprintWalk final : public SurfaceWalk {
public:
    using SurfaceWalk::SurfaceWalk;

    [[nodiscard]] std::uint64_t result() {
        _mixer.add(std::uint64_t{isKnown()});
        return _mixer.result();
    }

private:
    void visit(osgTerrain::TerrainTile& tile) override {
        addMatrix(localToEcef());
        if (const osgTerrain::Locator* locator = masterLocator(tile)) {
            _mixer.add(static_cast<std::uint64_t>(locator->getCoordinateSystemType()));
            addMatrix(locator->getTransform());
            if (const osg::EllipsoidModel* ellipsoid = locator->getEllipsoidModel()) {
                _mixer.add(ellipsoid->getRadiusEquator());
                _mixer.add(ellipsoid->getRadiusPolar());
            }
        }
        const osgTerrain::Layer* layer = tile.getElevationLayer();
        if (!layer) return;
        const osg::HeightField* field = heightField(tile);
        if (field) _mixer.add(static_cast<double>(field->getSkirtHeight()));
        if (field && !layer->getValidDataOperator()) {
            addHeights(*field);
        } else if (field || !dynamic_cast<const osgTerrain::HeightFieldLayer*>(layer)) {
            addHeights(*layer);
        }
    }

    void visit(osg::Drawable& drawable) override {
        addMatrix(localToEcef());
        const osg::Geometry* geometry = drawable.asGeometry();
        if (!geometry) return addBox(drawable.getBoundingBox());
        if (!isDrawnByItsVertices(drawable)) _mixer.add(std::uint64_t{1});
        if (drawable.getInitialBound().valid()) addBox(drawable.getInitialBound());
        addArray(geometry->getVertexArray());
        addArray(geometry->getTexCoordArray(0));
        const osg::Array* const vertices = geometry->getVertexArray();
        for (const auto& primitives : geometry->getPrimitiveSetList())
            if (primitives) addPrimitives(*primitives, vertices ? vertices->getNumElements() : 0);
    }

    void visitBillboard(osg::Billboard& node) override {
        for (const osg::Vec3& position : node.getPositionList())
            for (int axis = 0; axis < 3; ++axis) _mixer.add(static_cast<double>(position[axis]));
        traverse(node);
    }

    void visitUnknown(osg::Node& node) override {
        addMatrix(localToEcef());
        osg::BoundingBox box;
        box.expandBy(node.getBound());
        addBox(box);
    }

    void addBox(const osg::BoundingBox& box) {
        for (unsigned int i = 0; i < 8; ++i)
            for (int axis = 0; axis < 3; ++axis) _mixer.add(static_cast<double>(box.corner(i)[axis]));
    }

    void addHeights(const osg::HeightField& field) {
        addSize(field.getNumColumns(), field.getNumRows());
        const auto& heights = field.getFloatArray()->asVector();
        _mixer.addArray<std::uint32_t>(heights.data(), std::size_t{field.getNumColumns()} * field.getNumRows());
    }

    void addHeights(const osgTerrain::Layer& layer) {
        addSize(layer.getNumColumns(), layer.getNumRows());
        for (unsigned int row = 0; row < layer.getNumRows(); ++row) {
            for (unsigned int column = 0; column < layer.getNumColumns(); ++column) {
                float value = 0.0f;
                _mixer.add(std::uint64_t{layer.getValidValue(column, row, value)});
                _mixer.add(static_cast<double>(value));
            }
        }
    }

    void addSize(unsigned int columns, unsigned int rows) { _mixer.add((std::uint64_t{columns} << 32) | rows); }

    void addMatrix(const osg::Matrixd& matrix) { _mixer.addArray<std::uint64_t>(matrix.ptr(), 16); }

    void addArray(const osg::Array* array) {
        if (!array) return _mixer.add(std::uint64_t{0});
        _mixer.add(static_cast<std::uint64_t>(array->getType()));
        // made of 4-byte values, or else of 8-byte ones, as far as the bin is read from it
        const std::size_t words = array->getTotalDataSize() / sizeof(std::uint32_t);
        if (array->getDataType() == GL_DOUBLE)
            return _mixer.addArray<std::uint64_t>(array->getDataPointer(), words / 2);
        if (array->getDataType() == GL_FLOAT) _mixer.addArray<std::uint32_t>(array->getDataPointer(), words);
    }

    void addPrimitives(const osg::PrimitiveSet& primitives, unsigned int vertices) {
        _mixer.add((static_cast<std::uint64_t>(primitives.getMode()) << 32) | primitives.getNumIndices());
        if (const auto* shorts = dynamic_cast<const osg::DrawElementsUShort*>(&primitives))
            return _mixer.addArray<std::uint16_t>(shorts->getDataPointer(), shorts->size());
        if (const auto* ints = dynamic_cast<const osg::DrawElementsUInt*>(&primitives))
            return _mixer.addArray<std::uint32_t>(ints->getDataPointer(), ints->size());
        // ranges that go beyond the vertices, which may claim billions, are not read
        const bool isRange = primitives.getDrawElements() == nullptr;
        const unsigned int count = primitives.getNumIndices();
        if (isRange && count > vertices) return;
        for (unsigned int i = 0; i < count; ++i) _mixer.add(std::uint64_t{primitives.index(i)});
    }

    WordMixer _mixer;
};

}  // namespace

std::uint64_t surfaceFingerprint(osg::Node& node, const osg::Matrixd& localToEcef) {
    FingerprintWalk walk(localToEcef);
    node.accept(walk);
    return walk.result();
}

}  // namespace osgAnalyticBin
