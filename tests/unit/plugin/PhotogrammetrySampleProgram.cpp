// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Writes a photogrammetry set of any size by a formula, to measure on: FOLDER TILES-PER-SIDE LEVELS TEXTURE-SIZE.

#include <cstdlib>
#include <iostream>
#include <support/PhotogrammetrySample.h>

int main(int argc, char** argv) {
    if (argc != 5) {
        std::cerr << "usage: " << argv[0] << " FOLDER TILES-PER-SIDE LEVELS TEXTURE-SIZE" << std::endl;
        return EXIT_FAILURE;
    }
    osgAnalyticBin::test::PhotogrammetrySample sample;
    sample.tilesPerSide = std::atoi(argv[2]);
    sample.levels = std::atoi(argv[3]);
    sample.textureSize = static_cast<unsigned int>(std::atoi(argv[4]));
    const std::string file = osgAnalyticBin::test::writePhotogrammetrySample(argv[1], sample);
    if (file.empty()) {
        std::cerr << argv[1] << " cannot be written" << std::endl;
        return EXIT_FAILURE;
    }
    std::cout << file << std::endl;
    return EXIT_SUCCESS;
}
