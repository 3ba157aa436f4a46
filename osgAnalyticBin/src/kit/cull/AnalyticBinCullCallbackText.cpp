// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The properties of the callback as text, as files hold them.

#include "../Text.h"
#include "../tile/InstalledTile.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace osgAnalyticBin {

namespace {

// In place of radii.
constexpr const char* kMap = "map";

}  // namespace

void AnalyticBinCullCallback::setBinText(const std::string& text) {
    std::istringstream items(text);
    std::string item;
    std::getline(items, item, ';');
    AnalyticBin bin = AnalyticBin::fromText(item);
    while (std::getline(items, item, ';')) {
        if (readItem(item)) continue;
        refuse("an item beside the bin is malformed");
        return;
    }
    setBin(bin);
}

// One of "installed", "skirt 100", "surface BIN", "terrain 1 1 0 0".
bool AnalyticBinCullCallback::readItem(const std::string& item) {
    const std::size_t begin = std::min(item.find_first_not_of(' '), item.size());
    const std::size_t end = std::min(item.find(' ', begin), item.size());
    const std::string name = item.substr(begin, end - begin);
    const std::string value = item.substr(end);
    if (name == "installed") return _wasInstalled = true;
    if (name == "skirt") {
        const auto metres = numbersFromText(value, 1);
        if (metres) _skirt = metres->front();
        return metres.has_value();
    }
    if (name == "surface") {
        setSurface(AnalyticBin::fromText(value));
        return _surface.valid();
    }
    const auto shape = name == "terrain" ? numbersFromText(value, 4) : std::nullopt;
    if (!shape) return false;
    const double margin = (*shape)[3] >= 0.0 ? (*shape)[3] : HUGE_VAL;
    setTerrainShape(TerrainShape{(*shape)[0], (*shape)[1], (*shape)[2] != 0.0, margin});
    return true;
}

std::string AnalyticBinCullCallback::getBinText() const {
    if (!_bin.valid() || (_installed && _installed->has(InstalledTile::Outgrown))) return {};
    std::string text = _bin.toText();
    if (isInstalled()) text += "; installed";
    if (_skirt != 0.0) text += "; skirt " + numberToText(_skirt);
    if (_surface.valid()) text += "; surface " + _surface.toText();
    if (const auto& shape = _setup->shape) {
        const double margin = shape->isKnown() ? shape->techniqueMargin : -1.0;
        text += "; terrain " + numbersToText({shape->verticalScale, shape->sampleRatio,
                                              shape->areBoundariesEqual ? 1.0 : 0.0, margin});
    }
    return text;
}

void AnalyticBinCullCallback::setOptionsText(const std::string& text) {
    setCullOptions(storedCullOptions(text));
}

std::string AnalyticBinCullCallback::getOptionsText() const {
    return toText(_setup->options);
}

void AnalyticBinCullCallback::setRadiiText(const std::string& text) {
    if (text == kMap) return setRadii(HUGE_VAL, HUGE_VAL);
    const auto radii = numbersFromText(text, 2);
    if (radii && (*radii)[0] > 0.0 && (*radii)[1] > 0.0) {
        setRadii((*radii)[0], (*radii)[1]);
        return;
    }
    refuse(("the radii \"" + text.substr(0, 80) + "\" are not two positive numbers").c_str());
}

std::string AnalyticBinCullCallback::getRadiiText() const {
    if (isInMap()) return kMap;
    return numbersToText({_setup->equatorialRadius, _setup->polarRadius});
}

void AnalyticBinCullCallback::setLocalToEcefText(const std::string& text) {
    if (text.empty()) return;
    const auto values = numbersFromText(text, 16);
    if (values) {
        setLocalToEcef(osg::Matrixd(values->data()));
        return;
    }
    refuse("the matrix to ECEF is not sixteen numbers");
}

void AnalyticBinCullCallback::refuse(const char* why) {
    OSG_WARN << "AnalyticBinCullCallback: " << why << "; the tile is never culled." << std::endl;
    setBin(AnalyticBin());
}

std::string AnalyticBinCullCallback::getLocalToEcefText() const {
    if (!_frame) return {};
    return numbersToText(std::vector<double>(_frame->toEcef.ptr(), _frame->toEcef.ptr() + 16));
}

}  // namespace osgAnalyticBin
