#pragma once
/// Checks for all cases, and for points in closed meshes.

#include <algorithm>
#include <vector>

#include "proof/shadows/case_lines.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

/// Counts lines of which something is visible, although not even a short gap may be left.
/// \param order function applied to each occluder first, such as in_order_of_position().
/// \param alter function applied to the part that an occluder hides of lines.
template <class Order, class Alter>
int count_leaks(const ShadowCase& test, const Order& order, const Alter& alter) {
    const CaseLines lines(test);
    std::vector<Interval<float>> hidden[kLinesPerCase];
    lines.for_each_occluder(order, [&](const Interval<Lines>& all) {
        const Interval<Lines> part = alter(all);
        const std::uint32_t hides = (part.begin < part.end).bits();
        if (hides == 0) return;
        float begin[kLinesPerCase], end[kLinesPerCase];
        part.begin.store(begin);
        part.end.store(end);
        for (int i = 0; i < kLinesPerCase; ++i)
            if ((hides >> i & 1u) != 0) hidden[i].push_back({begin[i], end[i]});
    });
    int leaks = 0;
    for (int i = 0; i < kLinesPerCase; ++i) {
        std::sort(hidden[i].begin(), hidden[i].end(),
                  [](const auto& a, const auto& b) { return a.begin < b.begin; });
        float dark_until = lines.whole().begin.lane(i);
        for (const Interval<float>& part : hidden[i])
            if (part.begin <= dark_until) dark_until = max(dark_until, part.end);
        leaks += dark_until < lines.whole().end.lane(i);
    }
    return leaks;
}

/// Counts lines of which VisibleParts finds something visible.
inline int count_visible(const ShadowCase& test) {
    const CaseLines lines(test);
    constexpr int kCapacity = 64;
    Interval<Lines> storage[kCapacity];
    VisibleParts<Lines> parts(storage, kCapacity);
    parts.reset(lines.whole());
    lines.for_each_occluder(in_order_of_position, [&](const Interval<Lines>& hidden) { parts.cut(hidden); });
    int visible = 0;
    for (int i = 0; i < kLinesPerCase; ++i) visible += parts.lit().lane(i);
    return visible;
}

/// Checks a point in a closed mesh and a light outside.
/// \returns what is wrong, or null
inline const char* leak(const ShadowCase& test) {
    if (count_leaks(test, in_order_of_position, [](const auto& part) { return part; }) > 0)
        return "neighbouring triangles leave a gap";
    return count_visible(test) > 0 ? "something is visible through a closed mesh" : nullptr;
}

/// Checks that lines lose what is hidden and nothing else: parts are finite, disjoint and within the line, and no
/// occluder makes more of the line visible.
/// \param[out] visible share of each line in the end.
/// \returns what is wrong, or null
inline const char* broken_parts(const ShadowCase& test, float (&visible)[kLinesPerCase]) {
    const CaseLines lines(test);
    constexpr int kCapacity = 12; // some lines have more parts
    Interval<Lines> storage[kCapacity];
    VisibleParts<Lines> parts(storage, kCapacity);
    const Interval<Lines>& whole = lines.whole();
    parts.reset(whole);
    const auto visible_length = [&] {
        Lines sum(0.0f);
        for (int k = 0; k < parts.count(); ++k) sum = sum + max(parts[k].end - parts[k].begin, Lines(0.0f));
        return sum;
    };
    const char* problem = nullptr;
    const Lines whole_length = whole.end - whole.begin;
    const Lines rounding = Lines(1e-5f) * whole_length;
    Lines before = visible_length();
    if (any(before > whole_length)) problem = "more than the whole line is visible";
    lines.for_each_occluder(in_order_of_position, [&](const Interval<Lines>& hidden) {
        parts.cut(hidden);
        const Lines after = visible_length();
        if (!all(after <= before + rounding)) problem = "an occluder adds light";
        before = after;
    });
    if (parts.count() < 0 || parts.count() > kCapacity) problem = "too many parts";
    const Interval<Lines>& bounds = parts.bounds();
    for (int k = 0; k < parts.count(); ++k) {
        const Interval<Lines>& a = parts[k];
        const auto used = a.begin < a.end;
        if (any(used & ((a.begin < whole.begin) | (a.end > whole.end))))
            problem = "a part is not on the line";
        if (any(used & ((a.begin < bounds.begin) | (a.end > bounds.end))))
            problem = "a part is out of the bounds of all parts";
        for (int j = 0; j < k; ++j) {
            const Interval<Lines>& b = parts[j];
            if (any(used & (b.begin < b.end) & (a.begin < b.end) & (b.begin < a.end)))
                problem = "parts overlap";
        }
    }
    if (!all(is_finite(before) & (before >= Lines(0.0f)))) problem = "the visible length is not a number";
    const auto has_length = whole_length > Lines(0.0f);
    select(has_length, before / select(has_length, whole_length, Lines(1.0f)), Lines(0.0f)).store(visible);
    return problem;
}

} // namespace shadows
NUSSELT_NAMESPACE_END
