// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "Output.h"
#include "TextFile.h"

#include <osgDB/ConvertBase64>
#include <osgDB/Registry>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace osgAnalyticBin::bench {

namespace {

using report::htmlText;
using report::TextTable;

constexpr int kPictureWidth = 640;

constexpr const char* kStyle =
    "body { font-family: sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222 }\n"
    "table { border-collapse: collapse; margin: 1em 0; font-size: 0.85em }\n"
    "th, td { text-align: right; padding: 0.15em 0.7em } .left { text-align: left }\n"
    "tbody { border-top: 1px solid #999 } tbody tr:nth-child(even) { background: #f3f3f3 }\n"
    ".partial { background: #fc6; padding: 0.5em 1em; font-weight: bold }\n"
    "figure { display: inline-block; margin: 0.3em; width: 47% } img, svg { width: 100%; height: auto }\n";

/// A folder that goes with it.
class Scratch {
public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "osgbinbench.XXXXXX").string();
        if (!::mkdtemp(name.data())) throw support::Failure(name + ": the folder cannot be made");
        _folder = name;
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(_folder, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    [[nodiscard]] const std::filesystem::path& folder() const { return _folder; }

private:
    std::filesystem::path _folder;
};

void writeDiagrams(std::ostream& page, const std::vector<Diagram>& diagrams) {
    const Scratch scratch;
    try {
        plot(scratch.folder().string(), diagrams);
    } catch (const support::Failure&) {
        page << "<p>The diagrams need gnuplot (Debian: gnuplot-nox).</p>\n";
        return;
    }
    for (const Diagram& diagram : diagrams) {
        const std::string svg = support::contentOf((scratch.folder() / (diagram.name + ".svg")).string());
        page << svg.substr(svg.find("<svg")) << '\n';
    }
}

void writePicture(std::ostream& page, const std::string& name, const osg::Image& picture) {
    osgDB::ReaderWriter* const writer = osgDB::Registry::instance()->getReaderWriterForExtension("png");
    const osg::ref_ptr<osg::Image> small = new osg::Image(picture, osg::CopyOp::DEEP_COPY_ALL);
    if (small->s() > kPictureWidth) small->scaleImage(kPictureWidth, small->t() * kPictureWidth / small->s(), 1);
    std::stringstream png, text;
    if (!writer || !writer->writeImage(*small, png).success()) return;
    osgDB::Base64encoder().encode(png, text);
    page << "<figure><img alt=\"" << htmlText(name) << "\" src=\"data:image/png;base64," << text.str()
         << "\"><figcaption>" << htmlText(name) << "</figcaption></figure>\n";
}

TextTable meanings() {
    TextTable table(2);
    table.add({"figure", "meaning"});
    for (const Column& column : kPoseColumns) table.add({column.name, column.meaning});
    return table;
}

}  // namespace

std::string HtmlReport::html() const {
    std::ostringstream page;
    page << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>osgbinbench: "
         << htmlText(database) << "</title>\n<style>\n"
         << kStyle << "</style>\n</head>\n<body>\n<h1>Are bins worth it for " << htmlText(database) << "?</h1>\n";
    if (!partial.empty()) page << "<p class=\"partial\">" << htmlText(partial) << "</p>\n";
    for (const std::string& sentence : sentences) page << "<p>" << htmlText(sentence) << "</p>\n";
    page << "<h2>Diagrams</h2>\n";
    writeDiagrams(page, diagrams);
    page << "<h2>Pictures</h2>\n";
    for (const auto& [name, picture] : pictures) writePicture(page, name, *picture);
    page << "<h2>Tables</h2>\n";
    for (const TextTable& table : tables) table.printHtml(page);
    page << "<h2>What the figures mean</h2>\n";
    meanings().printHtml(page);
    page << "</body>\n</html>\n";
    return page.str();
}

}  // namespace osgAnalyticBin::bench
