// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Endian>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace osgAnalyticBin {

/// Appends what it is given to `bytes`, little endian, bit for bit the same when read back. A function template over
/// writer and reader describes a record for both directions.
class RecordWriter final {
public:
    template <class T>
    void number(const T& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        if (osg::getCpuByteOrder() == osg::BigEndian) osg::swapBytes(&bytes[bytes.size() - sizeof value], sizeof value);
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
    void numbers(const std::vector<double>& list) {
        count(list);
        for (const double value : list) number(value);
    }
    void bin(const AnalyticBin& value) {
        flag(value.valid());
        if (!value.valid()) return;
        for (const core::Interval& i : {value.bin().latitude(), value.bin().longitude(), value.bin().altitude()}) {
            number(i.lower);
            number(i.upper);
        }
        number(value.margin());
        number(value.sag());
    }

    std::string bytes;
};

/// Takes the same in the same order. Throws std::out_of_range at the end.
class RecordReader final {
public:
    explicit RecordReader(std::string_view bytes) : _rest(bytes) {}

    template <class T>
    void number(T& value) {
        char* const first = reinterpret_cast<char*>(&value);
        take(sizeof value).copy(first, sizeof value);
        if (osg::getCpuByteOrder() == osg::BigEndian) osg::swapBytes(first, sizeof value);
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
    void numbers(std::vector<double>& list) {
        count(list);
        for (double& value : list) number(value);
    }
    void bin(AnalyticBin& value) {
        bool isValid = false;
        flag(isValid);
        value = AnalyticBin();
        if (!isValid) return;
        core::Interval latitude, longitude, altitude;
        for (core::Interval* i : {&latitude, &longitude, &altitude}) {
            number(i->lower);
            number(i->upper);
        }
        double margin = 0.0;
        double sag = 0.0;
        number(margin);
        number(sag);
        value = AnalyticBin(core::GeodeticBin(latitude, longitude, altitude), margin);
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

}  // namespace osgAnalyticBin
