// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a file of a database names besides the tiles that it pages: osgbinconv opens none of it outside of the
// database's folder, on no server, and what is inside as OSG does.

#include "Binconv.h"

#include <osgAnalyticBin/BinIndex.h>

#include <gtest/gtest.h>
#include <osg/Group>
#include <osg/Image>
#include <osg/ProxyNode>
#include <osg/Texture2D>
#include <osgDB/Options>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <algorithm>
#include <arpa/inet.h>
#include <filesystem>
#include <netinet/in.h>
#include <poll.h>
#include <support/TemporaryFolder.h>
#include <support/VisitNodes.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

void expectRefusal(const Outcome& outcome, const std::string& name) {
    expectFailure(outcome, "names \"" + name + "\", which is outside of the database's folder");
}

/// A file that nobody may open: one who does waits for ever.
std::string trap(const std::string& path) {
    fs::create_directories(fs::path(path).parent_path());
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
}

/// A server on this machine that notices whoever connects.
class Listener {
public:
    Listener() : _socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* const generic = reinterpret_cast<sockaddr*>(&address);
        EXPECT_EQ(::bind(_socket, generic, size), 0);
        EXPECT_EQ(::listen(_socket, 8), 0);
        EXPECT_EQ(::getsockname(_socket, generic, &size), 0);
        _url = "http://127.0.0.1:" + std::to_string(ntohs(address.sin_port)) + "/";
    }
    ~Listener() { ::close(_socket); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    [[nodiscard]] const std::string& url() const { return _url; }
    [[nodiscard]] bool wasAsked() const {
        pollfd state{_socket, POLLIN, 0};
        return ::poll(&state, 1, 0) > 0;
    }

private:
    int _socket;
    std::string _url;
};

osg::ref_ptr<osg::Node> tileWith(osg::Node& other) {
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(makeSmallTile("a.osgb"));
    group->addChild(&other);
    return group;
}

osg::ref_ptr<osg::Node> tileWithProxy(const std::string& name) {
    const osg::ref_ptr<osg::ProxyNode> proxy = new osg::ProxyNode;
    proxy->setFileName(0, name);
    return tileWith(*proxy);
}

osg::ref_ptr<osg::Node> tileWithTexture(const std::string& name) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setFileName(name);
    image->setWriteHint(osg::Image::EXTERNAL_FILE);
    const osg::ref_ptr<osg::Node> tile = makeSmallTile("a.osgb");
    tile->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(image));
    return tile;
}

/// The first byte of the texture in a scene; -1: there is none.
int shadeOf(osg::Node& scene) {
    int shade = -1;
    visitNodes(scene, [&](osg::Node& node) {
        auto* const state = node.getStateSet();
        auto* const texture = state ? state->getTextureAttribute(0, osg::StateAttribute::TEXTURE) : nullptr;
        const osg::Image* const image = texture ? dynamic_cast<osg::Texture2D&>(*texture).getImage() : nullptr;
        if (image && image->data()) shade = image->data()[0];
    });
    return shade;
}

class NestedReads : public ::testing::Test {
protected:
    void SetUp() override {
        // else OSG writes other names into .ive files
        osgDB::Registry::instance()->setOptions(new osgDB::Options("useOriginalExternalReferences"));
        writeFile(folder / "db/a.osgb", *makeSmallTile(""));
        (void)folder.makeFolder("copy");
    }

    void TearDown() override { osgDB::Registry::instance()->setOptions(nullptr); }

    void writeRootFile(osg::Node& tile, const std::string& name = "earth.osgb") {
        root = folder / ("db/" + name);
        writeRoot(root, tile);
    }
    void writePicture(const std::string& name, unsigned char shade) const {
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(2, 2, 1, GL_RGB, GL_UNSIGNED_BYTE);
        std::fill_n(image->data(), image->getTotalSizeInBytes(), shade);
        fs::create_directories(fs::path(folder / name).parent_path());
        ASSERT_TRUE(osgDB::writeImageFile(*image, folder / name));
    }
    [[nodiscard]] Outcome copy() const { return runCopy(root, folder / "copy/earth.osgb", "--overwrite"); }
    [[nodiscard]] osg::ref_ptr<osg::Node> copied() const { return osgDB::readRefNodeFile(folder / "copy/earth.osgb"); }

    void expectCopyRefuses(const std::string& name) const {
        expectRefusal(copy(), name);
        EXPECT_TRUE(fs::is_empty(folder / "copy"));
    }
    void expectIndexAndCopyRefuse(const std::string& name) const {
        expectRefusal(runIndex(root), name);
        EXPECT_FALSE(fs::exists(root + ".bins"));
        EXPECT_FALSE(fs::exists(root + ".bins.part"));
        expectCopyRefuses(name);
    }

    const TemporaryFolder folder;
    std::string root;
};

TEST_F(NestedReads, ProxiesThatLeaveTheFolderAreRefusedUnopened) {
    const std::string outside = trap(folder / "outside.osgb");
    const Listener server;
    std::vector<std::string> names{"../outside.osgb",   "b/../../outside.osgb",  "..\\outside.osgb",          outside,
                                   "file://" + outside, server.url() + "x.osgb", server.url() + "x.osgb.curl"};
    for (const char* file : {"earth.osgb", "earth.osgt", "earth.osgx", "earth.ive"}) {
        for (const std::string& name : names) {
            writeRootFile(*tileWithProxy(name), file);
            expectIndexAndCopyRefuse(name);
        }
        names = {names.front(), names.back()};  // every format hands names to the same rule
    }
    EXPECT_FALSE(server.wasAsked());
    // The name leaves neither the folder of the file that names it nor that of the one above, but the folder of both.
    writeRootFile(*tileWithProxy("sub/b.osgb"));
    writeFile(folder / "db/sub/b.osgb", *tileWithProxy("../../outside.osgb"));
    expectIndexAndCopyRefuse("../../outside.osgb");
}

TEST_F(NestedReads, AProxyOfItselfEnds) {
    writeRootFile(*tileWithProxy("b.osgb"));
    writeFile(folder / "db/b.osgb", *tileWithProxy("earth.osgb"));
    expectFailure(runIndex(root), "read below itself");
}

// Its tiles are those of the file that names it, as OSG puts them there; a copy has them inside.
TEST_F(NestedReads, AProxyInsideOfTheFolderIsRead) {
    for (const std::string extension : {"osgb", "ive"}) {
        writeRootFile(*tileWithProxy("sub/b." + extension), "earth." + extension);
        writeFile(folder / ("db/sub/b." + extension), *tileWithProxy("../c." + extension));
        writeFile(folder / ("db/c." + extension), *makeSmallTile("a.osgb", 5.0));
        EXPECT_EQ(runIndex(root).code, 0);
        EXPECT_TRUE(indexOf(root)->find("", 2)) << extension;
        EXPECT_EQ(copy().code, 0);
        const osg::ref_ptr<osg::Node> scene = copied();
        ASSERT_TRUE(scene);
        int meshes = 0;
        visitNodes(*scene, [&](osg::Node& node) { meshes += node.asDrawable() ? 1 : 0; });
        EXPECT_EQ(meshes, 3) << extension;
    }
}

TEST_F(NestedReads, FilesOfTheWorkingDirectoryAreNotTakenForOnesOfTheDatabase) {
    (void)trap(folder / "b.osgb");
    (void)trap(folder / "picture.png");
    const osg::ref_ptr<osg::Group> both = new osg::Group;
    both->addChild(tileWithProxy("b.osgb"));
    both->addChild(tileWithTexture("picture.png"));
    writeRootFile(*both);
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    EXPECT_EQ(runIndex("db/earth.osgb").code, 0);
    EXPECT_EQ(runCopy("db/earth.osgb", "copy/e.osgb").code, 0);
    fs::current_path(before);
}

TEST_F(NestedReads, TexturesOutsideOfTheFolderAreRefusedByCopiesAlone) {
    const std::string secret = trap(folder / "secret.png");
    const Listener server;
    for (const char* file : {"earth.osgb", "earth.ive"}) {
        for (const std::string& name :
             {std::string("../secret.png"), std::string("..\\secret.png"), secret, server.url() + "secret.png"}) {
            writeRootFile(*tileWithTexture(name), file);
            expectSuccess(runIndex(root));
            expectCopyRefuses(name);
        }
    }
    EXPECT_EQ(copy().linesWith("put a copy beside"), 1);
    EXPECT_FALSE(server.wasAsked());
}

TEST_F(NestedReads, ARefusedTextureLeavesAnOlderCopyAsItIs) {
    writeRootFile(*makeSmallTile("a.osgb"));
    ASSERT_EQ(copy().code, 0);
    const std::string before = textOfFile(folder / "copy/earth.osgb");
    writeFile(folder / "db/a.osgb", *tileWithTexture("../secret.png"));
    writePicture("secret.png", 77);
    expectRefusal(copy(), "../secret.png");
    EXPECT_EQ(textOfFile(folder / "copy/earth.osgb"), before);
}

TEST_F(NestedReads, TexturesInsideOfTheFolderAreInTheCopy) {
    writePicture("db/images/picture.png", 50);
    writePicture("db/beside.png", 60);
    const std::pair<std::string, int> cases[] = {{"images/picture.png", 50},
                                                 {"./images/../images/picture.png", 50},
                                                 {folder / "db/images/picture.png", 50},
                                                 // as the line that refuses it says
                                                 {"../elsewhere/beside.png", 60}};
    for (const char* file : {"earth.osgb", "earth.ive"}) {
        for (const auto& [name, shade] : cases) {
            writeRootFile(*tileWithTexture(name), file);
            EXPECT_EQ(copy().code, 0);
            const osg::ref_ptr<osg::Node> scene = copied();
            ASSERT_TRUE(scene) << name;
            EXPECT_EQ(shadeOf(*scene), shade) << name;
        }
    }
}

TEST_F(NestedReads, FontsOutsideOfTheFolderAreNotOpened) {
    const Listener server;
    const std::string outside = trap(folder / "outside.ttf");
    const osg::ref_ptr<osg::Group> place = new osg::Group;
    place->setName("HERE");
    writeRootFile(*tileWith(*place), "earth.osgt");
    const std::string scene = textOfFile(root);
    const std::string mark = "Name \"HERE\" \n";
    ASSERT_NE(scene.find(mark), std::string::npos) << scene;
    for (const std::string& font : {outside, server.url() + "outside.ttf"}) {
        const std::string text = "Children 1 {\nosgText::Text {\nUniqueID 900 \nFont \"" + font + "\" \n}\n}\n";
        (void)folder.write("db/earth.osgt", std::string(scene).insert(scene.find(mark) + mark.size(), text));
        EXPECT_EQ(runIndex(root).code, 0);
        const Outcome copying = copy();
        if (font == outside) expectRefusal(copying, font);
        EXPECT_NE(copying.code, 124);  // for the other OSG may find one of the system's
    }
    EXPECT_FALSE(server.wasAsked());
}

}  // namespace
}  // namespace osgAnalyticBin::test
