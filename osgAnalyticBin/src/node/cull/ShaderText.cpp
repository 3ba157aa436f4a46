// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShaderText.h"

#include "../PerThread.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/Shader>
#include <osg/UserDataContainer>
#include <osg/ValueObject>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

namespace {

constexpr const char* kDrawsTriangles = "osgAnalyticBin.drawsTriangles";

// Without comments and white space.
std::string compact(const std::string& source) {
    std::string text;
    for (std::size_t i = 0; i < source.size(); ++i) {
        if (source.compare(i, 2, "//") == 0) {
            i = std::min(source.find('\n', i), source.size());
        } else if (source.compare(i, 2, "/*") == 0) {
            i = std::min(source.find("*/", i + 2), source.size() - 1) + 1;
        } else if (!std::isspace(static_cast<unsigned char>(source[i]))) {
            text += source[i];
        }
    }
    return text;
}

bool hasAny(const std::string& text, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return text.find(word) != std::string::npos; });
}

bool transformsPlainly(const std::string& vertexShaders) {
    const std::string output = "gl_Position";
    const std::size_t at = vertexShaders.find(output);
    if (at == std::string::npos || vertexShaders.rfind(output) != at) return false;
    const std::array<const char*, 3> plain{"=ftransform();", "=gl_ModelViewProjectionMatrix*gl_Vertex;",
                                           "=osg_ModelViewProjectionMatrix*osg_Vertex;"};
    const std::size_t after = at + output.size();
    return std::any_of(plain.begin(), plain.end(), [&](const char* expression) {
        return vertexShaders.compare(after, std::string(expression).size(), expression) == 0;
    });
}

bool isDeclared(const osg::Program& program) {
    bool draws = false;
    if (program.getUserDataContainer()) (void)program.getUserValue(kDrawsTriangles, draws);
    return draws;
}

bool mayAlterByText(const osg::Program& program) {
    std::string vertexShaders;
    for (unsigned int i = 0; i < program.getNumShaders(); ++i) {
        const osg::Shader& shader = *program.getShader(i);
        const std::string text = compact(shader.getShaderSource());
        if (text.empty() || hasAny(text, {"#pragma", "#include"})) return true;
        switch (shader.getType()) {
            case osg::Shader::FRAGMENT:
                if (hasAny(text, {"discard", "demote", "gl_FragDepth", "gl_SampleMask"})) return true;
                break;
            case osg::Shader::VERTEX:
                if (hasAny(text, {"#define", "gl_ClipDistance", "gl_ClipVertex"})) return true;
                vertexShaders += text;
                break;
            default:
                return true;
        }
    }
    return !vertexShaders.empty() && !transformsPlainly(vertexShaders);
}

// What was found for the shaders of one program.
struct ReadText {
    std::vector<std::pair<osg::Shader::Type, std::string>> shaders;
    bool mayAlter = false;

    [[nodiscard]] bool isOf(const osg::Program& program) const {
        if (program.getNumShaders() != shaders.size()) return false;
        for (unsigned int i = 0; i < program.getNumShaders(); ++i) {
            const osg::Shader& shader = *program.getShader(i);
            if (shader.getType() != shaders[i].first || shader.getShaderSource() != shaders[i].second) return false;
        }
        return true;
    }
};

}  // namespace

bool mayAlterSurface(const osg::Program& program) {
    if (isDeclared(program)) return false;
    if (program.getProgramBinary()) return true;
    // states are asked in every cull traversal
    constexpr std::size_t kMostPrograms = 8;
    thread_local PerThread<std::array<ReadText, kMostPrograms>> kept;
    thread_local std::size_t next = 0;
    auto& known = *kept;
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const ReadText& text) { return text.isOf(program); });
    if (found != known.end()) return found->mayAlter;
    ReadText& text = known[next++ % kMostPrograms];
    text = {{}, mayAlterByText(program)};
    for (unsigned int i = 0; i < program.getNumShaders(); ++i)
        text.shaders.emplace_back(program.getShader(i)->getType(), program.getShader(i)->getShaderSource());
    return text.mayAlter;
}

void setDrawsTriangles(osg::Program& program) {
    program.setUserValue(kDrawsTriangles, true);
}

}  // namespace osgAnalyticBin
