// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"

#include "DatabaseFolder.h"
#include "Interruption.h"
#include "NodeFile.h"
#include "TileBuilder.h"
#include "WorkPlan.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <cpl_progress.h>
#include <ogr_spatialref.h>
#include <osg/CoordinateSystemNode>
#include <osg/Material>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

namespace osgbindem {

using osgAnalyticBin::support::stopRequested;

namespace {

/// Shows how much is done, in GDAL's manner.
class Progress {
public:
    Progress(bool isShown, double total) : _isShown(isShown), _total(total) { show(0.0); }

    void add(double amount) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _done += amount;
        show(std::min(_done / _total, 0.99));
    }
    void finish() { show(1.0); }

private:
    void show(double share) const {
        if (_isShown) GDALTermProgress(share, nullptr, nullptr);
    }

    std::mutex _mutex;
    bool _isShown;
    double _total;
    double _done = 0.0;
};

/// The tasks of the plan and what has become of them; shared by the threads.
class TaskQueue {
public:
    explicit TaskQueue(std::vector<Task> tasks) : _tasks(std::move(tasks)) {}

    /// Returns: nullptr when there is nothing left to do.
    const Task* next() {
        const std::lock_guard<std::mutex> guard(_mutex);
        return _error || _next >= _tasks.size() ? nullptr : &_tasks[_next++];
    }
    void finish(const Task& task, std::unique_ptr<BuiltTile> tile) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _built[task.tile] = std::move(tile);
    }
    void fail(std::exception_ptr error) {
        const std::lock_guard<std::mutex> guard(_mutex);
        if (!_error) _error = std::move(error);
        stopRequested.store(true);  // the other threads need not go on
    }
    [[nodiscard]] double weight() const {
        double sum = 0.0;
        for (const Task& task : _tasks) sum += task.weight;
        return sum;
    }
    /// Requires: the threads have ended. Throws what they threw.
    BuiltTiles& built() {
        if (_error) std::rethrow_exception(_error);
        return _built;
    }

private:
    std::mutex _mutex;
    std::vector<Task> _tasks;
    std::size_t _next = 0;
    BuiltTiles _built;
    std::exception_ptr _error;
};

void work(const Settings& settings, const TileLayout& layout, const DatabaseFolder& folder, TaskQueue& queue,
          Progress& progress) {
    try {
        TileBuilder builder(settings, layout, folder);
        BuiltTiles none;
        while (const Task* task = queue.next()) {
            builder.setLeafDone([&](const TileId& leaf) {
                progress.add(std::ldexp(task->weight, 2 * (task->tile.level - leaf.level)));
            });
            queue.finish(*task, builder.build(task->tile, none));
        }
    } catch (...) {
        queue.fail(std::current_exception());
    }
}

void runThreads(const Settings& settings, const TileLayout& layout, const DatabaseFolder& folder, TaskQueue& queue,
                Progress& progress) {
    std::vector<std::thread> threads;
    for (int i = 0; i < settings.threads; ++i) {
        threads.emplace_back([&] { work(settings, layout, folder, queue, progress); });
    }
    for (std::thread& thread : threads) thread.join();
}

TileLayout layoutFor(const Settings& settings, const DemMosaic& mosaic) {
    const int cells = settings.cells.value_or(TileLayout::cellsFor(mosaic.finestGlobalDeg()));
    const int levels = settings.levels.value_or(TileLayout::levelFor(mosaic.finestDeg(), cells));
    return TileLayout(cells, levels, settings.ellipsoid);
}

std::string wgs84Text() {
    OGRSpatialReference reference;
    reference.importFromEPSG(4326);
    char* text = nullptr;
    reference.exportToWkt(&text);
    const std::string result(text);
    CPLFree(text);
    return result;
}

osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const Settings& settings) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(
        new osg::EllipsoidModel(settings.ellipsoid.equatorialRadius(), settings.ellipsoid.polarRadius()));
    if (settings.isWgs84) {
        root->setFormat("WKT");
        root->setCoordinateSystem(wgs84Text());
    }
    // Lit, with the vertices' own colours.
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    root->getOrCreateStateSet()->setAttributeAndModes(material);
    return root;
}

/// Declares below what nothing is drawn: the globe is whole, so that what lies behind it is hidden.
void declareHorizon(osg::Group& root) {
    double lowest = 0.0;
    for (unsigned int i = 0; i < root.getNumChildren(); ++i) {
        const osgAnalyticBin::AnalyticBin bin = osgAnalyticBin::storedBin(*root.getChild(i));
        lowest = std::min(lowest, bin.bin().altitude().lower - bin.margin());
    }
    osgAnalyticBin::CullOptions options;
    options.horizonUse = osgAnalyticBin::HorizonUse::Given;
    options.horizon = std::floor(lowest);
    root.setUpdateCallback(new osgAnalyticBin::InstallBinsCallback(options));
}

/// Builds what the tasks have left above them, and the root file.
std::string finishRoot(const Settings& settings, TileBuilder& builder, BuiltTiles& ahead) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = makeRoot(settings);
    std::vector<osg::Geometry*> geometries;
    for (int y = 0; y < TileId::kStartRows; ++y) {
        for (int x = 0; x < TileId::kStartColumns; ++x) {
            const std::unique_ptr<BuiltTile> tile = builder.build({0, x, y}, ahead);
            root->addChild(tile->node);
            geometries.push_back(tile->geometry);
        }
    }
    builder.finishFile(geometries, 0);
    declareHorizon(*root);
    return nodeFileBytes(*root, settings.compress);
}

}  // namespace

void buildDatabase(const Settings& settings) {
    prepareNodeFiles();
    DemMosaic mosaic(settings);
    mosaic.requireData();
    const TileLayout layout = layoutFor(settings, mosaic);
    DatabaseFolder folder(settings.output);
    TileBuilder builder(settings, layout, folder);

    TaskQueue queue(planTasks(builder.mosaic(), builder.depths(), layout, settings.threads));
    Progress progress(!settings.quiet, queue.weight());
    runThreads(settings, layout, folder, queue, progress);
    folder.complete(finishRoot(settings, builder, queue.built()));
    progress.finish();
}

}  // namespace osgbindem
