// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The exit codes of the programs, as the guide has them in its table: 0, 1 for a failure, 2 for a wrong command line.
// What a program says then is tested beside the program.

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin {
namespace {

struct UsedProgram {
    std::string name;                // with its command
    std::string failing;             // arguments; @: a folder that is empty
    std::vector<std::string> wrong;  // arguments
};

void PrintTo(const UsedProgram& program, std::ostream* out) {
    *out << program.name;
}

class ExitCode : public testing::TestWithParam<UsedProgram> {
protected:
    void expectCode(int code, std::string arguments) {
        for (std::size_t at = 0; (at = arguments.find('@', at)) != std::string::npos; at += _folder.path().size())
            arguments.replace(at, 1, _folder.path());
        const test::Outcome outcome = test::runStock(
            "env -u DISPLAY PATH=" + test::quoted(PROGRAM_FOLDER) + ":\"$PATH\" " + GetParam().name + ' ' + arguments,
            test::Modules::Present);
        EXPECT_EQ(outcome.code, code) << arguments << '\n' << outcome.text;
        EXPECT_EQ(outcome.linesWith(GetParam().name + ": "), code == 0 ? 0 : 1) << arguments << '\n' << outcome.text;
    }

private:
    test::TemporaryFolder _folder;
};

TEST_P(ExitCode, Is0ForHelpAndVersion) {
    expectCode(0, "--help >/dev/null");
    expectCode(0, "--version");
}

TEST_P(ExitCode, Is1ForAFailure) {
    expectCode(1, GetParam().failing);
}

TEST_P(ExitCode, Is2ForAWrongCommandLine) {
    expectCode(2, "--nonsense");
    for (const std::string& arguments : GetParam().wrong) expectCode(2, arguments);
}

const std::vector<UsedProgram> kPrograms{
    {"osgbinbench",
     "--compare @/old.json @/new.json",
     {"", "earth.osgb --path p.csv --methods cube", "earth.osgb --compare old.json new.json",
      "earth.osgb --path p.csv --frames 9 --plot plots"}},
    {"osgbinbench report", "@/none @/bins", {""}},
    {"osgbinbench scale", "--json @/absent/scale.json", {"--cells 3", "--methods cube", "--series shape"}},
    {"osgbinconv", "--index @/earth.ive", {"", "earth.ive", "--index --check earth.ive", "--index earth.ive x.osgb"}},
    {"osgbindem",
     "@/absent.tif -o @/earth.osgb",
     {"", "-o earth.osgb", "a.tif -o earth.ive", "a.tif -o earth.osgb --cells 7",
      "a.tif -o earth.osgb --update --overwrite", "a.tif -o earth.osgb -te 1 2 0 3"}},
    {"osgbinpaper", "@/absent.tif", {"--levels 9", "--cameras none"}},
    {"osgbinviewer", "@/absent.osgb", {"", "earth.osgb --options metod=exact", "earth.osgb --frobnicate"}}};

INSTANTIATE_TEST_SUITE_P(Programs, ExitCode, testing::ValuesIn(kPrograms), [](const auto& program) {
    std::string name = program.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

}  // namespace
}  // namespace osgAnalyticBin
