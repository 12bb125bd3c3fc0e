// The techniques in GLSL and the functions below them are as accurate as in C++.

#include "common/effort.h"
#include "gpu_test.h"
#include "lab/parity/parity.h"
#include "related_parity.h"

#include <fmt/core.h>

#include <iostream>
#include <ostream>

namespace nusselt::parity {

void PrintTo(const ParityCase& parity_case, std::ostream* out) {
    *out << parity_case.subject << ", " << parity_case.name;
}

namespace {

class Parity : public GpuTest, public testing::WithParamInterface<ParityCase> {};

TEST_P(Parity, WithCpp) {
    const ParityEffort effort{nusselt_test::at_effort(100'000, 1'000'000)};
    const auto verdicts = GetParam().judge(device(), effort);
    ASSERT_FALSE(verdicts.empty());
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
        std::cout << fmt::format("largest ratio to C++: {:.2f}, {}; {} budgets cannot fail\n",
                                 verdict.largest_ratio, verdict.where, verdict.vacuous.size());
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
