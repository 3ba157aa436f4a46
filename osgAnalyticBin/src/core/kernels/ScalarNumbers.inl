// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What the tests ask of their numbers, for doubles: one lane. VectorNumbers.inl has the same for vectors.

#define INLINE inline
#define NOINLINE inline
#define ATTRIBUTES

template <class Real>
using Truth = bool;
template <class Real>
using Bits = std::uint32_t;  // one bit a plane

template <class Real>
constexpr std::size_t lanesOf() {
    return 1;
}

template <class Real>
Real broadcast(double x) {
    return x;
}
template <class Real>
Real load(const double* x) {
    return *x;
}

// As the vector units do it.
inline double larger(double a, double b) {
    return a > b ? a : b;
}
inline double smaller(double a, double b) {
    return a < b ? a : b;
}
inline double magnitude(double x) {
    return std::abs(x);
}
inline double negated(double x) {
    return -x;
}
inline double root(double x) {
    return std::sqrt(x);
}
inline double leastLane(double x) {
    return x;
}
inline double select(bool where, double yes, double no) {
    return where ? yes : no;
}

inline bool both(bool a, bool b) {
    return a && b;
}
inline bool either(bool a, bool b) {
    return a || b;
}
inline bool without(bool a, bool b) {
    return a && !b;
}
template <class Real>
bool neither(bool a, bool b) {
    return !a && !b;
}
template <class Real>
bool nowhere() {
    return false;
}
template <class Real>
bool anyWhere(bool where) {
    return where;
}

template <class Real>
bool isEverywhere(bool where) {
    return where;
}

template <class Real>
std::uint32_t bits(std::uint32_t all) {
    return all;
}
template <class Real>
std::uint32_t bitsWhere(bool where, std::uint32_t all) {
    return where ? all : 0;
}
template <class Real>
std::uint32_t zeroWhere(bool where, std::uint32_t bits) {
    return where ? 0 : bits;
}
inline std::uint32_t exclusive(std::uint32_t a, std::uint32_t b) {
    return a & ~b;
}
template <class Real>
bool whereBit(std::uint32_t bits, std::uint32_t bit) {
    return (bits & bit) != 0;
}
template <class Real>
bool isZero(std::uint32_t bits) {
    return bits == 0;
}
template <class Real>
bool isZeroEverywhere(std::uint32_t bits) {
    return bits == 0;
}
template <class Real>
std::uint32_t anyLane(std::uint32_t bits) {
    return bits;
}
template <class Real>
void store(std::uint32_t bits, std::uint32_t* to) {
    *to = bits;
}

inline void store(double x, double* to) {
    *to = x;
}

template <class Real>
void storeAll(std::uint32_t all, std::uint32_t* to) {
    *to = all;
}

template <class Real>
std::uint64_t laneBits(bool where) {
    return where ? 1 : 0;
}
template <class Real>
bool whereLanes(std::uint64_t slots) {
    return (slots & 1) != 0;
}
