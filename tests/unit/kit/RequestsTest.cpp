// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which files a view requests, of whom, and whom an application's nodes meet while it does.

#include "ApplicationGlobe.h"
#include "CullFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>

#include <set>

namespace osgAnalyticBin::test {
namespace {

// Stands for the DatabasePager: notes which nodes request files.
struct NotedRequests : osg::NodeVisitor::DatabaseRequestHandler {
    void requestNodeFile(const std::string&, osg::NodePath& path, float, const osg::FrameStamp*,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced*) override {
        nodes.insert(path.back());
        if (!request) request = new osg::Referenced;
    }
    std::set<const osg::Node*> nodes;
};

// A globe seen from afar, with a view that requests the finer file of each tile in view.
struct RequestingGlobe : MeshGlobe {
    RequestingGlobe() { visitor->setDatabaseRequestHandler(requests); }
    void cullOnce() {
        const osg::Vec3d eye = ecefDeg(22.5, 0.0, 3e6);
        (void)cull(*scene, CullView::lookAt(eye, {0, 0, 0}, {0, 0, 1}, 120.0), *visitor, ++frame);
    }
    const osg::ref_ptr<NotedRequests> requests = new NotedRequests;
};

// Also in a viewer whose time stands still, and in one that draws a single frame.
TEST(Requests, AreAllMadeInTheFirstView) {
    RequestingGlobe stock, globe;
    // tiles just due, and tiles long overdue
    for (RequestingGlobe* const each : {&stock, &globe}) {
        for (std::size_t i = 0; i < each->tiles.size(); ++i) each->tiles[i]->setRange(1, 0.0F, i % 2 ? 1e8F : 8e6F);
    }
    installBins(*globe.root);
    stock.cullOnce();
    globe.cullOnce();
    ASSERT_GT(stock.requests->nodes.size(), 6u);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < stock.tiles.size(); ++i) {
        const bool isRequested = globe.requests->nodes.count(globe.tiles[i]) > 0;
        seen += isRequested ? 1 : 0;
        EXPECT_LE(isRequested, stock.requests->nodes.count(stock.tiles[i]) > 0) << i;
    }
    EXPECT_GT(seen, 6u);
    globe.cullOnce();
    EXPECT_EQ(globe.requests->nodes.size(), seen) << "none was left for later";
}

TEST(Requests, MeetTheVisitorsOwnHandlerEverywhereInADatabase) {
    struct Query : osg::NodeCallback {
        void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
            handlers.insert(nv->getDatabaseRequestHandler());
            traverse(node, nv);
        }
        std::set<const osg::NodeVisitor::DatabaseRequestHandler*> handlers;
    };
    RequestingGlobe globe;
    const osg::ref_ptr<Query> query = new Query;
    for (const auto& tile : globe.tiles) tile->getChild(0)->addCullCallback(query);
    installBins(*globe.root);
    globe.cullOnce();
    ASSERT_EQ(query->handlers.size(), 1u);
    EXPECT_EQ(*query->handlers.begin(), globe.requests.get());
}

// With declared heights alone, files below tiles out of view may be due.
TEST(Requests, AreMadeByNoVisitorThatOnlySaysItIsACullVisitor) {
    struct Caster : osg::Group {
        void traverse(osg::NodeVisitor& nv) override {
            const bool saysSo = nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR;
            areReal = areReal && (!saysSo || dynamic_cast<osgUtil::CullVisitor*>(&nv));
            osg::Group::traverse(nv);
        }
        bool areReal = true;
    };
    RequestingGlobe globe;
    const osg::ref_ptr<Caster> caster = new Caster;
    for (const auto& tile : globe.tiles) tile->getChild(0)->asGroup()->addChild(caster);
    installBins(*globe.root);
    for (int i = 0; i < 40; ++i) {
        const osg::Vec3d eye = ecefDeg(22.5, 0.0, 3000.0);
        (void)cull(*globe.scene, CullView::lookAt(eye, eye + osg::Vec3d(200.0 * i, 1e4, 0), {1, 0, 0}, 30.0),
                   *globe.visitor, ++globe.frame);
    }
    EXPECT_TRUE(caster->areReal);
}

}  // namespace
}  // namespace osgAnalyticBin::test
