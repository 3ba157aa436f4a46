// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace osgAnalyticBin {

/// Tells damaged bytes from whole ones, for a later run of the same program; no protection against forgers.
[[nodiscard]] inline std::uint64_t checksumOf(std::string_view bytes) {
    return std::hash<std::string_view>()(bytes);
}

/// Appends values to `bytes` in the form that they have in memory, for a later run of the same program. A function
/// template over writer and reader describes a record for both directions.
class RecordWriter final {
public:
    template <class T>
    void value(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    /// The number of elements.
    template <class List>
    void count(const List& list) {
        value(static_cast<std::uint32_t>(list.size()));
    }
    /// A text, or a vector of what value() takes.
    template <class List>
    void list(const List& list) {
        static_assert(std::is_trivially_copyable_v<typename List::value_type>);
        count(list);
        bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(typename List::value_type));
    }

    /// All of it, with a checksum at its end.
    [[nodiscard]] std::string finish() {
        value(checksumOf(bytes));
        return std::move(bytes);
    }

    std::string bytes;
};

/// Takes the same in the same order. Throws std::out_of_range at the end, and for what finish() has not made.
class RecordReader final {
public:
    explicit RecordReader(std::string_view bytes) : _rest(bytes) {
        std::uint64_t checksum = 0;
        if (bytes.size() < sizeof checksum) throw std::out_of_range("checksum");
        _rest.remove_suffix(sizeof checksum);
        std::memcpy(&checksum, bytes.data() + _rest.size(), sizeof checksum);
        if (checksum != checksumOf(_rest)) throw std::out_of_range("checksum");
    }

    template <class T>
    void value(T& value) {
        take(&value, sizeof value);
    }
    template <class List>
    void count(List& list) {
        std::uint32_t size = 0;
        value(size);
        if (size > _rest.size()) throw std::out_of_range("list");
        list.resize(size);
    }
    template <class List>
    void list(List& list) {
        count(list);
        take(list.data(), list.size() * sizeof(typename List::value_type));
    }
    [[nodiscard]] bool isAtEnd() const { return _rest.empty(); }

private:
    void take(void* target, std::size_t size) {
        if (size > _rest.size()) throw std::out_of_range("bytes");
        _rest.copy(static_cast<char*>(target), size);
        _rest.remove_prefix(size);
    }

    std::string_view _rest;
};

}  // namespace osgAnalyticBin
