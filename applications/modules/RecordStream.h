// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace osgAnalyticBin {

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

    std::string bytes;
};

/// Takes the same in the same order. Throws std::out_of_range at the end.
class RecordReader final {
public:
    explicit RecordReader(std::string_view bytes) : _rest(bytes) {}

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
