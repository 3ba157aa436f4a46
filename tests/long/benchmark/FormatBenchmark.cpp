// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Bytes, times and GPU memory of tiles in other formats than a database has them: doc/results/formats.csv.
//     osganalyticbin_formats FOLDER...        each a folder of .osgb files as osgbindem makes them
// Folders of meshes are rewritten in every format; of packed tiles, much smaller than what they become, the reading
// alone is timed.

#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <osgDB/Registry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 20;

double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

osgDB::ReaderWriter& plugin(const std::string& extension) {
    osgDB::ReaderWriter* found = osgDB::Registry::instance()->getReaderWriterForExtension(extension);
    if (found == nullptr) {
        std::fprintf(stderr, "formats: OpenSceneGraph's plugin for .%s is missing\n", extension.c_str());
        std::exit(EXIT_FAILURE);
    }
    return *found;
}

osg::ref_ptr<osgDB::Options> optionsWith(bool isCompressed) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setPluginStringData("fileType", "Binary");
    options->setPluginStringData("WriteImageHint", "IncludeData");
    if (isCompressed) options->setPluginStringData("Compressor", "zlib");
    return options;
}

osg::ref_ptr<osg::Node> nodeOf(const std::string& bytes) {
    std::istringstream stream(bytes);
    return plugin("osgb").readNode(stream, optionsWith(false)).getNode();
}

std::string bytesOf(const osg::Node& node, bool isCompressed) {
    std::ostringstream stream;
    plugin("osgb").writeNode(node, stream, optionsWith(isCompressed));
    return stream.str();
}

/// Every n-th file, in the order of their names.
std::vector<std::string> sample(const std::string& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".osgb") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    const std::size_t step = std::max<std::size_t>(1, paths.size() / kMostFiles);
    std::vector<std::string> files;
    for (std::size_t i = 0; i < paths.size(); i += step) {
        std::ifstream stream(paths[i], std::ios::binary);
        files.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    return files;
}

class Geometries : public osg::NodeVisitor {
public:
    explicit Geometries(std::function<void(osg::Geometry&)> function)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _function(std::move(function)) {}

    void apply(osg::Geometry& geometry) override { _function(geometry); }

private:
    std::function<void(osg::Geometry&)> _function;
};

using Change = std::function<void(osg::Geometry&)>;

double reachOf(const osg::Vec3Array& vertices) {
    double reach = 0.0;
    for (const osg::Vec3& vertex : vertices)
        for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(double{vertex[axis]}));
    return reach;
}

/// Floats that hold no more than shorts could, and so compress better.
void roundPositions(osg::Geometry& geometry) {
    auto& vertices = dynamic_cast<osg::Vec3Array&>(*geometry.getVertexArray());
    const double step = std::exp2(std::ceil(std::log2(reachOf(vertices) / 32767.0)));
    for (osg::Vec3& vertex : vertices)
        for (int axis = 0; axis < 3; ++axis)
            vertex[axis] = static_cast<float>(std::nearbyint(double{vertex[axis]} / step) * step);
}

void shortPositions(osg::Geometry& geometry) {
    const auto& vertices = dynamic_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
    const double step = std::exp2(std::ceil(std::log2(reachOf(vertices) / 32767.0)));
    const osg::ref_ptr<osg::Vec3sArray> shorts = new osg::Vec3sArray;
    for (const osg::Vec3& vertex : vertices) {
        const auto part = [&](int axis) { return static_cast<GLshort>(std::nearbyint(double{vertex[axis]} / step)); };
        shorts->push_back(osg::Vec3s(part(0), part(1), part(2)));
    }
    geometry.setVertexArray(shorts);
}

void byteNormals(osg::Geometry& geometry) {
    const auto& normals = dynamic_cast<const osg::Vec3Array&>(*geometry.getNormalArray());
    const osg::ref_ptr<osg::Vec3bArray> bytes = new osg::Vec3bArray(osg::Array::BIND_PER_VERTEX);
    bytes->setNormalize(true);
    for (const osg::Vec3& normal : normals) {
        const auto part = [&](int axis) { return static_cast<GLbyte>(std::lround(127.0F * normal[axis])); };
        bytes->push_back(osg::Vec3b(part(0), part(1), part(2)));
    }
    geometry.setNormalArray(bytes);
}

void noNormals(osg::Geometry& geometry) {
    geometry.setNormalArray(nullptr);
}

struct Row {
    std::string name;
    double bytes = 0.0;
    double gpuBytes = 0.0;
    double writing = 0.0;
    double reading = 0.0;
    double tiles = 0.0;

    void print() const {
        const double perTile = 1.0 / std::max(1.0, tiles);
        std::printf("%-44s %10.0f %10.0f %10.3f %10.3f\n", name.c_str(), bytes * perTile, gpuBytes * perTile,
                    1e3 * writing * perTile, 1e3 * reading * perTile);
    }
};

void count(osg::Node& node, Row& row) {
    Geometries counter([&row](osg::Geometry& geometry) {
        row.tiles += 1.0;
        osg::Geometry::ArrayList arrays;
        geometry.getArrayList(arrays);
        for (const auto& array : arrays) row.gpuBytes += array->getTotalDataSize();
    });
    node.accept(counter);
}

Row measure(const std::string& name, const std::vector<std::string>& files, const Change& change, bool isCompressed) {
    Row row;
    row.name = name;
    for (const std::string& file : files) {
        const osg::ref_ptr<osg::Node> node = nodeOf(file);
        if (!node) continue;
        Geometries changer(change);
        node->accept(changer);
        double begin = processorSeconds();
        const std::string bytes = bytesOf(*node, isCompressed);
        row.writing += processorSeconds() - begin;
        row.bytes += static_cast<double>(bytes.size());
        begin = processorSeconds();
        const osg::ref_ptr<osg::Node> again = nodeOf(bytes);
        row.reading += processorSeconds() - begin;
        if (again) count(*again, row);
    }
    return row;
}

Row measureAsIs(const std::string& name, const std::vector<std::string>& files) {
    Row row;
    row.name = name;
    for (const std::string& file : files) {
        const double begin = processorSeconds();
        const osg::ref_ptr<osg::Node> node = nodeOf(file);
        row.reading += processorSeconds() - begin;
        row.bytes += static_cast<double>(file.size());
        if (node) count(*node, row);
    }
    return row;
}

void measureImages(const std::vector<std::string>& files, const std::string& extension) {
    double pixels = 0.0;
    double bytes = 0.0;
    double writing = 0.0;
    double reading = 0.0;
    for (const std::string& file : files) {
        const osg::ref_ptr<osg::Node> node = nodeOf(file);
        Geometries visitor([&](osg::Geometry& geometry) {
            const osg::StateSet* state = geometry.getStateSet();
            const auto* texture =
                state == nullptr
                    ? nullptr
                    : dynamic_cast<const osg::Texture2D*>(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
            if (texture == nullptr || texture->getImage()->isCompressed()) return;
            std::ostringstream stream;
            double begin = processorSeconds();
            plugin(extension).writeImage(*texture->getImage(), stream);
            writing += processorSeconds() - begin;
            std::istringstream back(stream.str());
            begin = processorSeconds();
            (void)plugin(extension).readImage(back);
            reading += processorSeconds() - begin;
            pixels += double{1} * texture->getImage()->s() * texture->getImage()->t();
            bytes += static_cast<double>(stream.str().size());
        });
        if (node) node->accept(visitor);
    }
    if (pixels == 0.0) return;
    std::printf("  image as %-6s bytes a texel %5.2f, writing %6.1f ns a texel, reading %6.1f ns a texel\n",
                extension.c_str(), bytes / pixels, 1e9 * writing / pixels, 1e9 * reading / pixels);
}

void measureMeshes(const std::vector<std::string>& files) {
    const Change none = [](osg::Geometry&) {};
    measure("float positions and normals", files, none, false).print();
    measure("the same, zlib", files, none, true).print();
    measure("byte normals", files, byteNormals, false).print();
    measure("byte normals, zlib", files, byteNormals, true).print();
    measure("no normals", files, noNormals, false).print();
    measure("no normals, zlib", files, noNormals, true).print();
    const Change both = [](osg::Geometry& geometry) {
        roundPositions(geometry);
        byteNormals(geometry);
    };
    measure("floats of 16 bits, byte normals, zlib", files, both, true).print();
    const Change shorts = [](osg::Geometry& geometry) {
        shortPositions(geometry);
        byteNormals(geometry);
    };
    measure("short positions, byte normals", files, shorts, false).print();
    measure("short positions, byte normals, zlib", files, shorts, true).print();
    for (const char* extension : {"jpeg", "png"}) measureImages(files, extension);
}

}  // namespace

int main(int argc, char** argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    std::printf("%-44s %10s %10s %10s %10s\n", "", "B/tile", "GPU B/tile", "write ms", "read ms");
    for (int i = 1; i < argc; ++i) {
        const std::vector<std::string> files = sample(argv[i]);
        if (files.empty()) {
            std::fprintf(stderr, "formats: no .osgb files below \"%s\"; name a folder of tiles\n", argv[i]);
            return EXIT_FAILURE;
        }
        std::printf("%s\n", argv[i]);
        (void)measureAsIs("warming up", files);
        const Row row = measureAsIs("as it is", files);
        row.print();
        if (row.gpuBytes < 5.0 * row.bytes) measureMeshes(files);
    }
    return EXIT_SUCCESS;
}
