// The techniques in GLSL and the functions below them are as accurate as in C++.

#include "common/effort.h"
#include "lab/parity/parity.h"
#include "platform_test.h"
#include "related_parity.h"

#include <fmt/core.h>

#include <iostream>
#include <ostream>

namespace nusselt::parity {

void PrintTo(const ParityCase& parity_case, std::ostream* out) {
    *out << parity_case.subject << ", " << parity_case.name;
}

namespace {

/// Whether the browser takes part: with each technique and published method once, and functions. Bounds on the number of vertices repeat code, and
/// estimates for polygons combine two techniques in 12 s of compiling.
bool runs_in_browser(const ParityCase& parity_case) {
    const std::string& name = parity_case.name;
    if (parity_case.subject == "technique" || parity_case.subject == "hostile lights")
        return name.back() != '7' && name.back() != '8';
    return parity_case.subject == "random numbers" || parity_case.subject == "published method" ||
           (parity_case.subject == "functions" && name != "estimates for polygons");
}

class Parity : public PlatformTest, public testing::WithParamInterface<ParityCase> {};

TEST_P(Parity, WithCpp) {
    const ParityEffort effort{nusselt_test::at_effort(100'000, 1'000'000)};
    const ShaderPlatform& vulkan = platform().vulkan();
    const bool in_browser = runs_in_browser(GetParam());
    const auto verdicts = GetParam().judge(in_browser ? platform() : vulkan, effort);
    ASSERT_EQ(verdicts.size(), (in_browser ? platform() : vulkan).variants().size());
    for (const auto& [variant, verdict] : verdicts) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_GE(verdict.lights, effort.lights_per_class());
        for (const std::string& excess : verdict.excesses) ADD_FAILURE() << excess;
        for (const std::string& where : verdict.vacuous) {
            const char* reason = reason_of_vacuous_budget(where);
            if (reason == nullptr)
                ADD_FAILURE() << "a budget that cannot fail: " << where;
            else
                std::cout << fmt::format("cannot fail: {} ({})\n", where, reason);
        }
        std::cout << fmt::format("{}: largest ratio to C++: {:.2f}, {}; {} budgets cannot fail\n",
                                 name_of(variant), verdict.largest_ratio, verdict.where,
                                 verdict.vacuous.size());
    }
}

std::string name_of_test(const testing::TestParamInfo<ParityCase>& info) {
    std::string name = info.param.subject + "_" + info.param.name;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}
INSTANTIATE_TEST_SUITE_P(All, Parity, testing::ValuesIn(parity_cases()), name_of_test);
INSTANTIATE_TEST_SUITE_P(Related, Parity, testing::ValuesIn(related_cases()), name_of_test);

} // namespace

} // namespace nusselt::parity
