// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ProgressLine.h"

#include "TextFile.h"

#include <algorithm>
#include <cmath>
#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace osgAnalyticBin::support {

namespace {

bool leadsToTerminal(std::FILE* stream) {
#if defined(_WIN32)
    return ::_isatty(::_fileno(stream)) != 0;
#else
    return ::isatty(::fileno(stream)) == 1;
#endif
}

/// Seconds as people say them: "40 s", "12 min", "3 h 05 min".
std::string durationText(double seconds) {
    if (seconds < 90.0) return withDecimals(std::ceil(seconds), 0) + " s";
    const double minutes = std::ceil(seconds / 60.0);
    if (minutes < 90.0) return withDecimals(minutes, 0) + " min";
    const double hours = std::floor(minutes / 60.0), rest = minutes - 60.0 * hours;
    return withDecimals(hours, 0) + (rest < 10.0 ? " h 0" : " h ") + withDecimals(rest, 0) + " min";
}

std::string percent(double share) {
    return withDecimals(100.0 * share, 0) + " %";
}

}  // namespace

std::string timeLeft(double share, double seconds, double skipped) {
    constexpr double kFirstSeconds = 3.0;
    if (!(share > skipped) || share >= 1.0 || seconds < kFirstSeconds) return {};
    return durationText(seconds * (1.0 - share) / (share - skipped)) + " left";
}

ProgressLine::ProgressLine(std::FILE* stream)
    : _stream(stream), _isTerminal(leadsToTerminal(stream)), _pause(_isTerminal ? 200 : 10000) {}

ProgressLine::~ProgressLine() {
    if (_width > 0) write("", "\r");
}

double ProgressLine::seconds() const {
    return std::chrono::duration<double>(Clock::now() - _start).count();
}

void ProgressLine::show(double share, const std::string& text) {
    const double shown = std::min(share, 0.99);
    const std::string time = timeLeft(shown, seconds(), _skipped);
    write(text + percent(shown) + (time.empty() ? "" : ", ") + time, _isTerminal ? "" : "\n");
}

void ProgressLine::finish(double share, const std::string& text) {
    write(text + percent(share) + ", done in " + durationText(seconds()), "\n");
    _width = 0;
}

void ProgressLine::write(const std::string& line, const char* end) {
    _shown = Clock::now();
    // Blanks erase the rest of a longer line.
    std::fprintf(_stream, "%s%-*s%s", _isTerminal ? "\r" : "", _width, line.c_str(), end);
    std::fflush(_stream);
    _width = _isTerminal ? static_cast<int>(line.size()) : 0;
}

}  // namespace osgAnalyticBin::support
