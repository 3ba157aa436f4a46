// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

/// What libFuzzer and ReplaySeeds.cpp call with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace osgAnalyticBin::test {

/// Ends the program, in every kind of build, where a property does not hold.
inline void require(bool holds) {
    if (!holds) std::abort();
}

/// What a failure says has to be one line.
inline void requireOneLine(const std::runtime_error& failure) {
    const std::string text = failure.what();
    require(!text.empty() && text.find('\n') == std::string::npos);
}

/// Takes choices and numbers from an input, front to back; when it is used up all are zero.
class Bytes final {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : _data(data), _end(data + size) {}

    [[nodiscard]] bool empty() const { return _data == _end; }
    [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(_end - _data); }

    [[nodiscard]] std::uint8_t byte() { return empty() ? std::uint8_t{0} : *_data++; }
    /// From 0 to below `count`. Requires: 0 < count <= 256.
    [[nodiscard]] int below(int count) { return byte() % count; }
    template <class T, std::size_t N>
    [[nodiscard]] const T& pick(const std::array<T, N>& choices) {
        return choices[byte() % N];
    }
    [[nodiscard]] bool flag() { return byte() % 2 == 1; }

    /// Between the two, in 65536 steps.
    [[nodiscard]] double between(double lower, double upper) {
        const int high = byte();
        return lower + (upper - lower) * (256 * high + byte()) / 65535.0;
    }

    /// One of the numbers that break programs, or any eight bytes.
    [[nodiscard]] double number() {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        constexpr std::array<double, 16> kOdd{0.0, -0.0,  1.0,    -1.0,  90.0,  -180.0, 1e-310,    1e-9,
                                              1e9, 1e155, -1e155, 1e300, -1e38, kNaN,   kInfinity, -kInfinity};
        const std::size_t choice = byte();
        if (choice < 128) return kOdd[choice % kOdd.size()];
        if (choice < 192) return between(-400.0, 400.0);
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits |= std::uint64_t{byte()} << (8 * i);
        double value = 0.0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }

private:
    const std::uint8_t* _data;
    const std::uint8_t* _end;
};

}  // namespace osgAnalyticBin::test
