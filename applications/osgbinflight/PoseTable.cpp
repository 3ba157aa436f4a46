// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PoseTable.h"

#include "CsvTable.h"
#include "TextFile.h"

#include <array>
#include <filesystem>
#include <sstream>

namespace osgAnalyticBin::flight {

namespace {

struct CountColumn {
    const char* name;
    std::uint64_t TileCounts::*count;
};

constexpr std::array<CountColumn, 5> kCounts{{{"tested_tiles", &TileCounts::tested},
                                              {"kept_tiles", &TileCounts::kept},
                                              {"drawn_tiles", &TileCounts::drawn},
                                              {"drawables", &TileCounts::drawables},
                                              {"triangles", &TileCounts::triangles}}};

std::string textOf(const std::vector<PoseRecord>& records, const std::string& remark) {
    std::ostringstream output;
    output << "# " << remark << "\nname";
    for (const CountColumn& column : kCounts) output << ',' << column.name;
    output << ",files_requested,cull_ms,frame_ms,picture\n";
    for (const PoseRecord& record : records) {
        output << record.name;
        for (const CountColumn& column : kCounts) output << ',' << record.tiles.*column.count;
        output << ',' << record.files << ',' << textFrom(record.cullMs) << ',' << textFrom(record.frameMs) << ','
               << record.picture << '\n';
    }
    return output.str();
}

}  // namespace

void writePoseTable(const std::string& folder, const std::vector<PoseRecord>& records, const std::string& remark) {
    support::writeFile((std::filesystem::path(folder) / kPoseTableName).string(), textOf(records, remark));
}

}  // namespace osgAnalyticBin::flight
