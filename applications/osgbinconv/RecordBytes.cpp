// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RecordBytes.h"

#include <boost/endian/conversion.hpp>
#include <stdexcept>
#include <utility>

namespace osgbinconv {

namespace {

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::core::GeodeticBin;
using osgAnalyticBin::core::Interval;

/// Appends what it is given.
class Writer {
public:
    template <class T>
    void number(const T& value) {
        unsigned char buffer[sizeof(T)];
        boost::endian::endian_store<T, sizeof(T), boost::endian::order::little>(buffer, value);
        bytes.append(reinterpret_cast<const char*>(buffer), sizeof buffer);
    }
    void flag(const bool& value) { number(static_cast<std::uint8_t>(value)); }
    void text(const std::string& value) {
        number(static_cast<std::uint32_t>(value.size()));
        bytes += value;
    }
    template <class T>
    std::size_t count(const std::vector<T>& list) {
        number(static_cast<std::uint32_t>(list.size()));
        return list.size();
    }
    void bin(const AnalyticBin& value) {
        flag(value.valid());
        if (!value.valid()) return;
        for (const Interval& i : {value.bin().latitude(), value.bin().longitude(), value.bin().altitude()}) {
            number(i.lower);
            number(i.upper);
        }
        number(value.margin());
        number(value.sag());
    }

    std::string bytes;
};

/// Takes the same in the same order. Throws std::out_of_range at the end.
class Reader {
public:
    explicit Reader(std::string_view bytes) : _rest(bytes) {}

    template <class T>
    void number(T& value) {
        const std::string_view bytes = take(sizeof(T));
        value = boost::endian::endian_load<T, sizeof(T), boost::endian::order::little>(
            reinterpret_cast<const unsigned char*>(bytes.data()));
    }
    void flag(bool& value) {
        std::uint8_t byte = 0;
        number(byte);
        value = byte != 0;
    }
    void text(std::string& value) {
        std::uint32_t size = 0;
        number(size);
        value = std::string(take(size));
    }
    template <class T>
    std::size_t count(std::vector<T>& list) {
        std::uint32_t size = 0;
        number(size);
        if (size > _rest.size()) throw std::out_of_range("list");
        list.resize(size);
        return size;
    }
    void bin(AnalyticBin& value) {
        bool isValid = false;
        flag(isValid);
        value = AnalyticBin();
        if (!isValid) return;
        Interval latitude, longitude, altitude;
        for (Interval* i : {&latitude, &longitude, &altitude}) {
            number(i->lower);
            number(i->upper);
        }
        double margin = 0.0;
        double sag = 0.0;
        number(margin);
        number(sag);
        value = AnalyticBin(GeodeticBin(latitude, longitude, altitude), margin);
        value.setSag(sag);
    }
    [[nodiscard]] bool isAtEnd() const { return _rest.empty(); }

private:
    std::string_view take(std::size_t size) {
        if (size > _rest.size()) throw std::out_of_range("bytes");
        const std::string_view bytes = _rest.substr(0, size);
        _rest.remove_prefix(size);
        return bytes;
    }

    std::string_view _rest;
};

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
    Writer writer;
    passRecord(writer, record);
    return std::move(writer.bytes);
}

std::optional<FileRecord> recordFrom(std::string_view bytes) {
    try {
        Reader reader(bytes);
        FileRecord record;
        passRecord(reader, record);
        if (reader.isAtEnd() && isConsistent(record)) return record;
    } catch (const std::out_of_range&) {
    }
    return std::nullopt;
}

}  // namespace osgbinconv
