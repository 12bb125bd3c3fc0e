// scripts/test.sh compiles this file to see how fast the machine is at present, see machine_speed.sh. A change of this
// file changes all budgets.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <regex>
#include <string>
#include <variant>
#include <vector>

namespace {

template <int I>
double term(double x) {
    std::map<std::string, std::vector<double>> values;
    values[std::to_string(x)].push_back(std::sin(I * x));
    std::vector<std::function<double(double)>> steps{[](double y) { return y * I; },
                                                     [x](double y) { return y + x; }};
    std::sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a(1.0) < b(1.0); });
    double sum = 0;
    for (const auto& [name, numbers] : values)
        for (const double number : numbers) sum += steps.front()(number) + static_cast<double>(name.size());
    if constexpr (I > 0) sum += term<I - 1>(sum);
    return sum;
}

} // namespace

int main(int count, char** words) {
    std::mt19937 generator(static_cast<unsigned>(count));
    std::variant<double, std::string> value = term<4>(static_cast<double>(generator()));
    const std::regex pattern("([a-z]+)=([0-9]+)(,[0-9]+)*");
    for (int i = 1; i < count; ++i)
        if (std::regex_match(words[i], pattern)) value = words[i];
    return value.index() == 0 ? 0 : 1;
}
