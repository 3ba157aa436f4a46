// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a file of a database names besides the tiles that it pages: osgbinconv opens none of it outside of the
// database's folder, on no server, and what is inside as OSG does.

#include "BinconvRuns.h"
#include "SmallDatabase.h"

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
#include <fstream>
#include <netinet/in.h>
#include <poll.h>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>
#include <support/VisitNodes.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

Outcome runBounded(const std::string& arguments) {
    // what hangs at a pipe, or at a server, ends with 124
    return runStock("timeout 60 " + quoted(OSGBINCONV_PROGRAM) + " --quiet " + arguments, Modules::Present);
}

void expectRefusal(const Outcome& outcome, const std::string& name) {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.text.rfind("osgbinconv: ", 0), 0u) << outcome.text;
    EXPECT_NE(outcome.text.find("names \"" + name + "\", which is outside of the database's folder"), std::string::npos)
        << outcome.text;
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << outcome.text;
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

const osg::Image* textureOf(osg::Node& scene) {
    const osg::Image* image = nullptr;
    visitNodes(scene, [&](osg::Node& node) {
        auto* const state = node.getStateSet();
        auto* const texture = state ? state->getTextureAttribute(0, osg::StateAttribute::TEXTURE) : nullptr;
        if (texture) image = dynamic_cast<osg::Texture2D&>(*texture).getImage();
    });
    return image;
}

int meshesIn(osg::Node& scene) {
    int count = 0;
    visitNodes(scene, [&](osg::Node& node) { count += node.asDrawable() ? 1 : 0; });
    return count;
}

void writePicture(const std::string& path, unsigned char shade) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), shade);
    fs::create_directories(fs::path(path).parent_path());
    ASSERT_TRUE(osgDB::writeImageFile(*image, path));
}

class NestedReads : public ::testing::Test {
protected:
    void SetUp() override {
        // else OSG writes other names into .ive files
        osgDB::Registry::instance()->setOptions(new osgDB::Options("useOriginalExternalReferences"));
        writeSmallFile(_folder / "db/a.osgb", *makeSmallTile(""));
        fs::create_directories(_folder / "copy");
    }

    void TearDown() override { osgDB::Registry::instance()->setOptions(nullptr); }

    void writeRoot(osg::Node& tile, const std::string& name = "earth.osgb") {
        _root = _folder / ("db/" + name);
        writeSmallFile(_root, tile, true);
    }
    [[nodiscard]] Outcome index() const { return runBounded("--index " + quoted(_root)); }
    [[nodiscard]] Outcome copy(const std::string& options = {}) const {
        return runBounded(quoted(_root) + ' ' + quoted(_folder / "copy/earth.osgb") + options);
    }
    [[nodiscard]] osg::ref_ptr<osg::Node> copied() const { return osgDB::readRefNodeFile(_folder / "copy/earth.osgb"); }

    void expectIndexAndCopyRefuse(const std::string& name) const {
        expectRefusal(index(), name);
        EXPECT_FALSE(fs::exists(_root + ".bins"));
        EXPECT_FALSE(fs::exists(_root + ".bins.part"));
        expectRefusal(copy(), name);
        EXPECT_TRUE(fs::is_empty(_folder / "copy"));
    }

    TemporaryFolder _folder;
    std::string _root;
};

TEST_F(NestedReads, ProxiesThatLeaveTheFolderAreRefusedUnopened) {
    const std::string outside = trap(_folder / "outside.osgb");
    const Listener server;
    std::vector<std::string> names{"../outside.osgb",   "b/../../outside.osgb",  "..\\outside.osgb",          outside,
                                   "file://" + outside, server.url() + "x.osgb", server.url() + "x.osgb.curl"};
    for (const char* root : {"earth.osgb", "earth.osgt", "earth.osgx", "earth.ive"}) {
        for (const std::string& name : names) {
            writeRoot(*tileWithProxy(name), root);
            expectIndexAndCopyRefuse(name);
        }
        names = {names.front(), names.back()};  // every format hands names to the same rule
    }
    EXPECT_FALSE(server.wasAsked());
}

// The name leaves neither the folder of the file that names it nor that of the one above, but the folder of both.
TEST_F(NestedReads, AProxyInAProxyIsSeenFromItsOwnFolder) {
    (void)trap(_folder / "outside.osgb");
    writeRoot(*tileWithProxy("sub/b.osgb"));
    writeSmallFile(_folder / "db/sub/b.osgb", *tileWithProxy("../../outside.osgb"));
    expectIndexAndCopyRefuse("../../outside.osgb");
}

TEST_F(NestedReads, AProxyOfItselfEnds) {
    writeRoot(*tileWithProxy("b.osgb"));
    writeSmallFile(_folder / "db/b.osgb", *tileWithProxy("earth.osgb"));
    const Outcome outcome = index();
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.text.find("read below itself"), std::string::npos) << outcome.text;
}

// Its tiles are those of the file that names it, as OSG puts them there; a copy has them inside.
TEST_F(NestedReads, AProxyInsideOfTheFolderIsRead) {
    for (const std::string extension : {"osgb", "ive"}) {
        writeRoot(*tileWithProxy("sub/b." + extension), "earth." + extension);
        writeSmallFile(_folder / ("db/sub/b." + extension), *tileWithProxy("../c." + extension));
        writeSmallFile(_folder / ("db/c." + extension), *makeSmallTile("a.osgb", 5.0));
        const Outcome outcome = index();
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        const osg::ref_ptr<BinIndex> bins = indexOf(_root);
        EXPECT_TRUE(bins->find("", 2)) << extension;
        const Outcome copying = copy(" --overwrite");
        EXPECT_EQ(copying.code, 0) << copying.text;
        const osg::ref_ptr<osg::Node> scene = copied();
        ASSERT_TRUE(scene);
        EXPECT_EQ(meshesIn(*scene), 3) << extension;
    }
}

TEST_F(NestedReads, FilesOfTheWorkingDirectoryAreNotTakenForOnesOfTheDatabase) {
    (void)trap(_folder / "b.osgb");
    (void)trap(_folder / "picture.png");
    const osg::ref_ptr<osg::Group> both = new osg::Group;
    both->addChild(tileWithProxy("b.osgb"));
    both->addChild(tileWithTexture("picture.png"));
    writeRoot(*both);
    for (const std::string& arguments :
         {std::string("--index db/earth.osgb"), std::string("db/earth.osgb copy/e.osgb")}) {
        const std::string command =
            "cd " + _folder.path() + " && timeout 60 " + OSGBINCONV_PROGRAM + " --quiet " + arguments;
        const Outcome outcome = runStock("sh -c " + quoted(command), Modules::Present);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
    }
}

TEST_F(NestedReads, TexturesOutsideOfTheFolderAreRefusedByCopiesAlone) {
    const std::string secret = trap(_folder / "secret.png");
    const Listener server;
    for (const char* root : {"earth.osgb", "earth.ive"}) {
        for (const std::string& name :
             {std::string("../secret.png"), std::string("..\\secret.png"), secret, server.url() + "secret.png"}) {
            writeRoot(*tileWithTexture(name), root);
            const Outcome outcome = index();
            EXPECT_EQ(outcome.code, 0) << outcome.text;
            EXPECT_EQ(outcome.text, "");
            const Outcome copying = copy();
            expectRefusal(copying, name);
            EXPECT_NE(copying.text.find("put a copy beside"), std::string::npos) << copying.text;
            EXPECT_TRUE(fs::is_empty(_folder / "copy"));
        }
    }
    EXPECT_FALSE(server.wasAsked());
}

TEST_F(NestedReads, ARefusedTextureLeavesAnOlderCopyAsItIs) {
    writeRoot(*makeSmallTile("a.osgb"));
    ASSERT_EQ(copy().code, 0);
    const std::string before = textOfFile(_folder / "copy/earth.osgb");
    writeSmallFile(_folder / "db/a.osgb", *tileWithTexture("../secret.png"));
    writePicture(_folder / "secret.png", 77);
    expectRefusal(copy(" --overwrite"), "../secret.png");
    EXPECT_EQ(textOfFile(_folder / "copy/earth.osgb"), before);
}

TEST_F(NestedReads, TexturesInsideOfTheFolderAreInTheCopy) {
    writePicture(_folder / "db/images/picture.png", 50);
    writePicture(_folder / "db/beside.png", 60);
    const std::string inside = fs::absolute(_folder / "db/images/picture.png").string();
    const struct {
        std::string name;
        int shade;
    } cases[] = {{"images/picture.png", 50},
                 {"./images/../images/picture.png", 50},
                 {inside, 50},
                 // as the line that refuses it says
                 {"../elsewhere/beside.png", 60}};
    for (const char* root : {"earth.osgb", "earth.ive"}) {
        for (const auto& [name, shade] : cases) {
            writeRoot(*tileWithTexture(name), root);
            const Outcome outcome = copy(" --overwrite");
            EXPECT_EQ(outcome.code, 0) << outcome.text;
            const osg::ref_ptr<osg::Node> scene = copied();
            ASSERT_TRUE(scene) << name;
            const osg::Image* image = textureOf(*scene);
            ASSERT_TRUE(image && image->data()) << name;
            EXPECT_EQ(image->data()[0], shade) << name;
        }
    }
}

/// A text below the root, in the font of that name.
std::string withText(std::string scene, const std::string& font) {
    const std::string mark = "Name \"HERE\" \n";
    const std::size_t at = scene.find(mark);
    EXPECT_NE(at, std::string::npos) << scene;
    return scene.insert(at + mark.size(),
                        "Children 1 {\nosgText::Text {\nUniqueID 900 \nFont \"" + font + "\" \n}\n}\n");
}

TEST_F(NestedReads, FontsOutsideOfTheFolderAreNotOpened) {
    const Listener server;
    const std::string outside = trap(_folder / "outside.ttf");
    const osg::ref_ptr<osg::Group> place = new osg::Group;
    place->setName("HERE");
    for (const std::string& name : {outside, server.url() + "outside.ttf"}) {
        writeRoot(*tileWith(*place), "earth.osgt");
        const std::string scene = withText(textOfFile(_root), name);
        std::ofstream(_root, std::ios::binary | std::ios::trunc) << scene;
        const Outcome outcome = index();
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        const Outcome copying = copy();
        if (name == outside) expectRefusal(copying, name);
        EXPECT_NE(copying.code, 124);  // for the other OSG may find one of the system's
    }
    EXPECT_FALSE(server.wasAsked());
}

}  // namespace
}  // namespace osgAnalyticBin::test
