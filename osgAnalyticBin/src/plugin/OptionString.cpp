// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "OptionString.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <numeric>
#include <set>

namespace osgAnalyticBin::plugin {

namespace {

std::vector<std::string> itemsOf(const std::string& text) {
    std::vector<std::string> items;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find_first_of(" ,;", begin), text.size());
        if (end > begin) items.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return items;
}

// Edit distance of two words: letters inserted, left out or changed; two swapped letters count as one.
std::size_t typingErrors(const std::string& a, const std::string& b) {
    std::vector<std::size_t> beforeLast(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
            const bool isSwap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (isSwap) row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
        beforeLast.swap(last);
        last.swap(row);
    }
    return last[b.size()];
}

// Returns: the key of ours that a word may have been meant for; empty when there is none.
std::string meantBy(const std::string& word, const std::vector<std::string>& keys) {
    const std::string lower = osgDB::convertToLowerCase(word);
    const auto isMeant = [&](const std::string& key) {
        const std::size_t most = key.size() < 6 ? 1 : 2;
        return typingErrors(lower, key) <= most;
    };
    const auto found = std::find_if(keys.begin(), keys.end(), isMeant);
    return found == keys.end() ? std::string() : *found;
}

// The keys of all plugins that are loaded, our own left out: "OSG_CURL_TIMEOUT", "precision".
std::set<std::string> keysOfOtherPlugins(const std::vector<std::string>& own) {
    std::set<std::string> keys;
    for (const auto& reader : osgDB::Registry::instance()->getReaderWriterList()) {
        for (const auto& option : reader->supportedOptions())
            keys.insert(option.first.substr(0, option.first.find_first_of("= <")));
    }
    for (const std::string& key : own) keys.erase(key);
    return keys;
}

}  // namespace

OptionString parsedOptionString(const std::string& text) {
    OptionString parsed;
    if (text.empty()) return parsed;
    const std::vector<std::string> own = cullOptionKeys();
    const std::set<std::string> others = keysOfOtherPlugins(own);
    for (const std::string& item : itemsOf(text)) {
        const std::size_t equals = item.find('=');
        const bool hasValue = equals != std::string::npos;
        const std::string key = item.substr(0, equals);
        const bool isOwn = std::find(own.begin(), own.end(), key) != own.end();
        if (isOwn && hasValue) {
            parsed.items += item + ' ';
            continue;
        }
        if (others.count(key) > 0) continue;
        // a word without a value may be anything: another plugin's value, or one of its switches
        const std::string meant = isOwn ? key : hasValue ? meantBy(key, own) : std::string();
        if (!meant.empty()) {
            parsed.nearMisses.emplace_back(item, meant);
        } else if (hasValue) {
            parsed.unknown.push_back(item);
        }
    }
    if (parsed.items.empty()) parsed.unknown.clear();
    return parsed;
}

}  // namespace osgAnalyticBin::plugin
