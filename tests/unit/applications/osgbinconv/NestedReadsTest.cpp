// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a file of a database names besides the tiles that it pages: osgbinconv opens none of it outside of the
// database's folder, on no server, and what is inside as OSG does.

#include "Binconv.h"

#include <osg/Image>
#include <osg/ProxyNode>
#include <osg/Texture2D>
#include <osgDB/Options>
#include <osgDB/Registry>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

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
    return makeGroup({makeSmallTile("a.osgb"), &other});
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

class NestedReads : public ::testing::Test {
protected:
    void SetUp() override {
        // else OSG writes other names into .ive files
        osgDB::Registry::instance()->setOptions(new osgDB::Options("useOriginalExternalReferences"));
        writeFile(folder / "db/a.osgb", *makeSmallTile(""));
    }

    void TearDown() override { osgDB::Registry::instance()->setOptions(nullptr); }

    void writeRootFile(osg::Node& tile, const std::string& name = "earth.osgb") {
        root = folder / ("db/" + name);
        writeRoot(root, tile);
    }
    void expectRefused(const std::string& name) const {
        expectRefusal(runIndex(root), name);
        expectNoIndex(root);
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
            expectRefused(name);
        }
        names = {names.front(), names.back()};  // every format hands names to the same rule
    }
    EXPECT_FALSE(server.wasAsked());
    // The name leaves neither the folder of the file that names it nor that of the one above, but the folder of both.
    writeRootFile(*tileWithProxy("sub/b.osgb"));
    writeFile(folder / "db/sub/b.osgb", *tileWithProxy("../../outside.osgb"));
    expectRefused("../../outside.osgb");
}

TEST_F(NestedReads, AProxyOfItselfEnds) {
    writeRootFile(*tileWithProxy("b.osgb"));
    writeFile(folder / "db/b.osgb", *tileWithProxy("earth.osgb"));
    expectFailure(runIndex(root), "read below itself");
}

// Its tiles are those of the file that names it, as OSG puts them there.
TEST_F(NestedReads, AProxyInsideOfTheFolderIsRead) {
    for (const std::string extension : {"osgb", "ive"}) {
        writeRootFile(*tileWithProxy("sub/b." + extension), "earth." + extension);
        writeFile(folder / ("db/sub/b." + extension), *tileWithProxy("../c." + extension));
        writeFile(folder / ("db/c." + extension), *makeSmallTile("a.osgb", 5.0));
        EXPECT_EQ(runIndex(root).code, 0);
        EXPECT_TRUE(indexOf(root)->find("", 2)) << extension;
    }
}

TEST_F(NestedReads, FilesOfTheWorkingDirectoryAreNotTakenForOnesOfTheDatabase) {
    (void)trap(folder / "b.osgb");
    (void)trap(folder / "picture.png");
    writeRootFile(*makeGroup({tileWithProxy("b.osgb"), tileWithTexture("picture.png")}));
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    EXPECT_EQ(runIndex("db/earth.osgb").code, 0);
    fs::current_path(before);
}

TEST_F(NestedReads, TexturesAreNotOpened) {
    const std::string secret = trap(folder / "secret.png");
    const Listener server;
    for (const char* file : {"earth.osgb", "earth.ive"}) {
        for (const std::string& name : {std::string("../secret.png"), secret, server.url() + "secret.png"}) {
            writeRootFile(*tileWithTexture(name), file);
            expectSuccess(runIndex(root));
        }
    }
    EXPECT_FALSE(server.wasAsked());
}

TEST_F(NestedReads, FontsAreNotOpened) {
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
    }
    EXPECT_FALSE(server.wasAsked());
}

}  // namespace
}  // namespace osgAnalyticBin::test
