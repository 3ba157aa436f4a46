// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <cstdlib>
#include <support/Random.h>

namespace osgAnalyticBin::test {

namespace {

constexpr std::uint64_t kDefaultSeed = 20260101;
constexpr double kTwoPi = 6.28318530717958647692;

}  // namespace

std::uint64_t seed() {
    static const std::uint64_t value = [] {
        const char* text = std::getenv(kSeedVariable);
        return text != nullptr ? std::strtoull(text, nullptr, 0) : kDefaultSeed;
    }();
    return value;
}

Random::Random(std::uint64_t stream, std::uint64_t seedValue) noexcept : _state(seedValue) {
    _state = bits() ^ (stream * 0xD1342543DE82EF95u);
    _state = bits();
}

std::uint64_t Random::bits() noexcept {
    _state += 0x9E3779B97F4A7C15u;
    std::uint64_t z = _state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

double Random::uniform() noexcept {
    return static_cast<double>(bits() >> 11) * 0x1p-53;
}

double Random::uniform(double lower, double upper) noexcept {
    return lower + (upper - lower) * uniform();
}

double Random::logUniform(double lower, double upper) noexcept {
    return lower * std::exp(uniform() * std::log(upper / lower));
}

int Random::integer(int lower, int upper) noexcept {
    return lower + static_cast<int>(uniform() * (static_cast<double>(upper) - lower + 1.0));
}

glm::dvec3 Random::direction() noexcept {
    const double z = uniform(-1.0, 1.0);
    const double angle = uniform(0.0, kTwoPi);
    const double rho = std::sqrt(1.0 - z * z);
    return {rho * std::cos(angle), rho * std::sin(angle), z};
}

}  // namespace osgAnalyticBin::test
