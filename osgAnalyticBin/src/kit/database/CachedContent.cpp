// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CachedContent.h"

#include "../Classes.h"
#include "../tile/EachNode.h"

#include <osg/ClusterCullingCallback>
#include <osg/CopyOp>
#include <osg/Drawable>
#include <osg/Group>
#include <osgDB/ObjectCache>
#include <osgDB/Registry>

#include <typeinfo>

namespace osgAnalyticBin {

namespace {

// A group's family of tiles is put behind its callbacks, which are shared.
bool hasForeignCallback(const osg::Node& node) {
    const osg::Callback* const callback = node.getCullCallback();
    return callback && !isExactly<osg::ClusterCullingCallback>(*callback);
}

// Whether all nodes were copied as what they are.
bool isFaithful(const osg::Node& original, const osg::Node& copy) {
    if (&original == &copy) return original.asDrawable() != nullptr;
    if (typeid(original) != typeid(copy) || hasForeignCallback(original)) return false;
    const osg::Group* const group = original.asGroup();
    if (!group) return true;
    const osg::Group& copiedGroup = *copy.asGroup();
    bool isSame = copiedGroup.getNumChildren() == group->getNumChildren();
    for (unsigned int i = 0; isSame && i < group->getNumChildren(); ++i)
        isSame = isFaithful(*group->getChild(i), *copiedGroup.getChild(i));
    return isSame;
}

}  // namespace

osg::ref_ptr<osg::Node> cachedNode(const std::string& fileName, const osgDB::Options& options) {
    if (!(options.getObjectCacheHint() & osgDB::Options::CACHE_NODES)) return nullptr;
    // the pager's own cache is merged into the Registry's when the tile is merged into the scene
    osgDB::ObjectCache* const registrys = osgDB::Registry::instance()->getObjectCache();
    for (osgDB::ObjectCache* const cache : {const_cast<osgDB::Options&>(options).getObjectCache(), registrys}) {
        const osg::ref_ptr<osg::Object> found = cache ? cache->getRefFromObjectCache(fileName, &options) : nullptr;
        if (found) return dynamic_cast<osg::Node*>(found.get());
    }
    return nullptr;
}

osg::ref_ptr<osg::Node> copyForBins(const osg::Node& content) {
    const osg::ref_ptr<osg::Node> copy = osg::clone(&content, osg::CopyOp(osg::CopyOp::DEEP_COPY_NODES));
    return copy && isFaithful(content, *copy) ? copy : nullptr;
}

void replaceBelow(osg::Node& root, osg::Node& old, osg::Node& fresh) {
    forEachNode(root, [&](osg::Node& node) {
        osg::Group* const group = node.asGroup();
        for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
            if (group->getChild(i) == &old) group->setChild(i, &fresh);
        }
    });
}

}  // namespace osgAnalyticBin
