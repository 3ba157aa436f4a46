// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RecordBytes.h"

#include "RecordStream.h"

#include <stdexcept>
#include <utility>

namespace osgbinconv {

namespace {

/// One description of the bytes for both directions.
template <class Stream, class Tile>
void passTile(Stream& s, Tile& tile) {
    s.bin(tile.surface.bin);
    for (auto& low : tile.surface.edgeLow) s.number(low);
    s.number(tile.surface.skirt);
    s.flag(tile.surface.isScalable);
    s.flag(tile.surface.isInMap);
    s.number(tile.fingerprint);
    s.number(tile.parent);
}

template <class Stream, class Place>
void passPlace(Stream& s, Place& place) {
    s.number(place.equatorialRadius);
    s.number(place.polarRadius);
    s.flag(place.isProjected);
    for (auto& number : place.localToEcef) s.number(number);
    s.flag(place.isBelowTile);
    s.number(place.sampleRatio);
}

template <class Stream, class Link>
void passLink(Stream& s, Link& link) {
    s.text(link.file);
    s.number(link.tile);
    passPlace(s, link.place);
}

template <class Stream, class Record>
void passRecord(Stream& s, Record& record) {
    s.text(record.file);
    s.number(record.stamp.size);
    s.number(record.stamp.time);
    s.number(record.stamp.nanoseconds);
    passPlace(s, record.place);
    s.flag(record.isRead);
    s.flag(record.hasOtherContent);
    s.count(record.tiles);
    for (auto& tile : record.tiles) passTile(s, tile);
    s.count(record.links);
    for (auto& link : record.links) passLink(s, link);
}

bool isConsistent(const FileRecord& record) {
    const auto tiles = static_cast<std::int32_t>(record.tiles.size());
    for (std::int32_t i = 0; i < tiles; ++i) {
        const std::int32_t parent = record.tiles[static_cast<std::size_t>(i)].parent;
        if (parent < -1 || parent >= i) return false;
    }
    for (const FileLink& link : record.links) {
        if (link.tile < -1 || link.tile >= tiles) return false;
    }
    return true;
}

}  // namespace

std::string bytesOf(const FileRecord& record) {
    osgAnalyticBin::RecordWriter writer;
    passRecord(writer, record);
    return std::move(writer.bytes);
}

std::optional<FileRecord> recordFrom(std::string_view bytes) {
    try {
        osgAnalyticBin::RecordReader reader(bytes);
        FileRecord record;
        passRecord(reader, record);
        if (reader.isAtEnd() && isConsistent(record)) return record;
    } catch (const std::out_of_range&) {
    }
    return std::nullopt;
}

}  // namespace osgbinconv
