// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace osgAnalyticBin::core {

/// Numbers the different keys of a mesh: 0, 1, 2, .... Keys are arrays of 64-bit words. The
/// table uses open addressing and two blocks of memory, because bins are installed while the viewer waits for tiles.
template <class Key>
class KeyNumbers {
public:
    KeyNumbers() = default;
    explicit KeyNumbers(std::size_t most) { begin(most); }

    /// Forgets all keys, and keeps the memory. Requires: there will be at most `most` different keys.
    void begin(std::size_t most) {
        _keys.clear();
        std::size_t size = 16;
        while (size < 2 * most) size *= 2;
        _numbers.assign(size, kNone);
        _keys.reserve(most);
    }

    /// Returns: the number of the key. A key that is not known yet gets the next one.
    [[nodiscard]] std::uint32_t numberOf(const Key& key) {
        std::uint32_t& number = _numbers[slotOf(key)];
        if (number != kNone) return number;
        number = static_cast<std::uint32_t>(_keys.size());
        _keys.push_back(key);
        return number;
    }

    /// The keys in the order of their numbers.
    [[nodiscard]] const std::vector<Key>& keys() const { return _keys; }

private:
    static constexpr std::uint32_t kNone = 0xffffffff;

    [[nodiscard]] std::size_t slotOf(const Key& key) const {
        std::uint64_t hash = 0;
        for (const std::uint64_t part : key) hash = (hash ^ (part >> 29) ^ part) * 0x9e3779b97f4a7c15u;
        std::size_t slot = (hash >> 20) & (_numbers.size() - 1);
        while (_numbers[slot] != kNone && !isSame(_keys[_numbers[slot]], key))
            slot = (slot + 1) & (_numbers.size() - 1);
        return slot;
    }

    // == calls memcmp(), which takes longer.
    [[nodiscard]] static bool isSame(const Key& a, const Key& b) {
        bool is = true;
        for (std::size_t i = 0; i < a.size(); ++i) is = is && a[i] == b[i];
        return is;
    }

    std::vector<std::uint32_t> _numbers;
    std::vector<Key> _keys;
};

/// The bits of a number, to be used in a key. Equal numbers have equal bits.
[[nodiscard]] inline std::uint64_t bitsOf(double value) {
    const double plain = value + 0.0;  // one zero
    std::uint64_t bits = 0;
    std::memcpy(&bits, &plain, sizeof bits);
    return bits;
}

}  // namespace osgAnalyticBin::core
