/// Times our techniques and the published formulas as scalar code, on one thread. It depends on the library alone, so
/// that it compiles with any compiler and options; docs/performance.md shows its table.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "lab/timing/scalar/instructions.h"
#include "lab/timing/scalar/rows.h"

namespace nusselt::lab {

namespace {

const char* const kHelp =
    "Times our techniques and the published formulas as scalar float code on one thread.\n"
    "\n"
    "  --vertices N        polygons of 3 to 7 corners, or `all`; default 4\n"
    "  --rows TEXT         only rows whose technique or class of lights contains it\n"
    "  --repetitions R     of the interleaved loops; default 401\n"
    "  --instructions      also counts instructions, step by step, which takes a minute\n"
    "  --json FILE         also writes all numbers; `-` writes them instead of the table\n"
    "  --run CODE LOOP N   runs only one loop of the first row N times, for profilers; CODE is ours or\n"
    "                      published, LOOP is transform, prepare, from_world, sample, direction or once\n";

struct Options {
    int vertices = 4; ///< 0 for all
    std::string rows, json, run_code, run_loop;
    int repetitions = 401;
    int run_count = 0;
    bool instructions = false;
};

[[noreturn]] void fail(const std::string& message) {
    std::fprintf(stderr, "%s\n\n%s", message.c_str(), kHelp);
    std::exit(2);
}

Options parse(int argc, char** argv) {
    Options o;
    int i = 1;
    const auto next = [&] {
        if (i >= argc) fail("an option lacks its value");
        return std::string(argv[i++]);
    };
    const auto positive = [&] {
        const std::string text = next();
        const int number = std::atoi(text.c_str());
        if (number <= 0) fail("not a positive number: " + text);
        return number;
    };
    while (i < argc) {
        const std::string option = next();
        if (option == "--vertices") {
            const std::string text = next();
            o.vertices = text == "all" ? 0 : std::atoi(text.c_str());
            if (text != "all" && (o.vertices < 3 || o.vertices > 7)) fail("not a number of corners: " + text);
        } else if (option == "--rows") {
            o.rows = next();
        } else if (option == "--repetitions") {
            o.repetitions = positive();
        } else if (option == "--instructions") {
            o.instructions = true;
        } else if (option == "--json") {
            o.json = next();
        } else if (option == "--run") {
            o.run_code = next();
            o.run_loop = next();
            o.run_count = positive();
        } else if (option == "--help") {
            std::fputs(kHelp, stdout);
            std::exit(0);
        } else {
            fail("unknown option: " + option);
        }
    }
    return o;
}

#if defined(__clang__)
constexpr const char* kCompiler = __VERSION__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif
#define NUSSELT_NAME_OF(x) #x
#define NUSSELT_TEXT_OF(x) NUSSELT_NAME_OF(x)
/// The instruction set that the library sees, e.g. isa_avx512.
constexpr const char* kIsa = NUSSELT_TEXT_OF(NUSSELT_ISA);

constexpr double kNone = -1;

/// Times per light or sample [ns] without the baseline, or numbers of instructions.
struct Costs {
    double transform = kNone, prepare = kNone, from_world = kNone, sample = kNone, direction = kNone,
           once = kNone;
};

/// What is measured.
struct Measured {
    const char* name;
    double Costs::*cost;
    void (*Loops::*loop)(int, int);
    bool takes_prepared; ///< calls Loops::keep before
    bool counted;        ///< also its instructions
};

constexpr Measured kMeasured[] = {
    {"transform", &Costs::transform, &Loops::transform, false, false},
    {"prepare", &Costs::prepare, &Loops::prepare, false, true},
    {"from_world", &Costs::from_world, &Loops::prepare_from_world, false, false},
    {"sample", &Costs::sample, &Loops::sample, true, true},
    {"direction", &Costs::direction, &Loops::direction, true, false},
    {"once", &Costs::once, &Loops::one_sample, false, false},
};

struct Result {
    const Row* row;
    Costs ours, published;                           ///< [ns]
    Costs ours_instructions, published_instructions; ///< kNone if they were not counted
};

/// The start of a window of lights.
int random_window(std::mt19937& generator) {
    return std::uniform_int_distribution<int>(0, kLights - kWindow)(generator);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The time per light of a loop [ns].
double time_once(const Loops& loops, const Measured& measured, std::mt19937& generator) {
    using Clock = std::chrono::steady_clock;
    const auto loop = loops.*measured.loop;
    // Code and tables get warm with other lights than those that are timed.
    if (measured.takes_prepared) loops.keep(random_window(generator), kWindow);
    loop(random_window(generator), kWindow);
    const int window = random_window(generator);
    const auto start = Clock::now();
    loop(window, kWindow);
    const std::chrono::duration<double, std::nano> elapsed = Clock::now() - start;
    return elapsed.count() / kWindow;
}

void time_row(Result& result, int repetitions) {
    const Row& row = *result.row;
    std::mt19937 generator(2);
    for (const Measured& measured : kMeasured) {
        const bool published_has_it = row.published.*measured.loop != nullptr;
        const bool ours_has_it = row.ours.*measured.loop != nullptr;
        std::vector<double> baseline, ours, published;
        for (int repetition = 0; repetition < repetitions; ++repetition) {
            baseline.push_back(time_once(row.baseline, measured, generator));
            if (ours_has_it) ours.push_back(time_once(row.ours, measured, generator));
            if (published_has_it) published.push_back(time_once(row.published, measured, generator));
        }
        if (ours_has_it) result.ours.*measured.cost = median(ours) - median(baseline);
        if (published_has_it) result.published.*measured.cost = median(published) - median(baseline);
    }
}

/// \returns whether instructions can be counted.
bool count_row(Result& result) {
    constexpr int kCounted = 16;
    const auto count = [&](const Loops& loops, const Measured& measured) {
        if (measured.takes_prepared) loops.keep(0, kCounted);
        return count_instructions(loops.*measured.loop, 0, kCounted);
    };
    for (const Measured& measured : kMeasured) {
        if (!measured.counted) continue;
        const auto baseline = count(result.row->baseline, measured);
        const auto ours = count(result.row->ours, measured);
        const auto published = count(result.row->published, measured);
        if (!baseline || !ours || !published) return false;
        result.ours_instructions.*measured.cost = static_cast<double>(*ours - *baseline) / kCounted;
        result.published_instructions.*measured.cost = static_cast<double>(*published - *baseline) / kCounted;
    }
    return true;
}

std::string number(double value, int decimals) {
    if (value == kNone) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string ratio(double a, double b) { return a == kNone || b == kNone ? "-" : number(a / b, 2); }

std::string pair(const std::string& a, const std::string& b) { return a + " / " + b; }

void print(const std::vector<Result>& results) {
    std::printf(
        "%s, %s\nns without the baseline; prepare / sample. x: over the published formulas. transform: to\n"
        "shading space. world: x of transform and prepare together. once: x of prepare with one sample.\n"
        "(...): the published formulas without density and hit point. instr: instructions.\n\n",
        kCompiler, kIsa);
    constexpr const char* kFormat = "%-28s%-22s%3s%16s%24s%14s%14s%7s%7s%16s%16s\n";
    std::printf(kFormat, "technique", "lights", "n", "ours", "published", "x", "transform", "world", "once",
                "instr", "published");
    for (const Result& r : results) {
        const Costs &ours = r.ours, &published = r.published;
        const auto counts = [](const Costs& c) { return pair(number(c.prepare, 0), number(c.sample, 0)); };
        const std::string own = pair(number(ours.prepare, 1), number(ours.sample, 1));
        const std::string other = pair(number(published.prepare, 1), number(published.sample, 1)) + " (" +
                                  number(published.direction, 1) + ")";
        const std::string ratios =
            pair(ratio(ours.prepare, published.prepare), ratio(ours.sample, published.sample));
        const std::string transforms = pair(number(ours.transform, 1), number(published.transform, 1));
        std::printf(kFormat, r.row->technique, r.row->lights.name, std::to_string(r.row->vertices).c_str(),
                    own.c_str(), other.c_str(), ratios.c_str(), transforms.c_str(),
                    ratio(ours.from_world, published.from_world).c_str(),
                    ratio(ours.once, published.once).c_str(), counts(r.ours_instructions).c_str(),
                    counts(r.published_instructions).c_str());
    }
}

void write(std::FILE* file, const char* name, const Costs& c) {
    std::fprintf(file, "\"%s\": {", name);
    const char* separator = "";
    for (const Measured& measured : kMeasured) {
        const double cost = c.*measured.cost;
        if (cost == kNone)
            std::fprintf(file, "%s\"%s\": null", separator, measured.name);
        else
            std::fprintf(file, "%s\"%s\": %.4g", separator, measured.name, cost);
        separator = ", ";
    }
    std::fprintf(file, "}");
}

void write_json(const std::string& path, const std::vector<Result>& results) {
    std::FILE* file = path == "-" ? stdout : std::fopen(path.c_str(), "w");
    if (!file) fail("cannot write " + path);
    std::fprintf(file, "{\"compiler\": \"%s\", \"isa\": \"%s\", \"rows\": [", kCompiler, kIsa);
    const char* separator = "\n";
    for (const Result& r : results) {
        std::fprintf(file, "%s{\"technique\": \"%s\", \"lights\": \"%s\", \"vertices\": %d,\n ", separator,
                     r.row->technique, r.row->lights.name, r.row->vertices);
        write(file, "ours_ns", r.ours);
        std::fprintf(file, ",\n ");
        write(file, "published_ns", r.published);
        std::fprintf(file, ",\n ");
        write(file, "ours_instructions", r.ours_instructions);
        std::fprintf(file, ",\n ");
        write(file, "published_instructions", r.published_instructions);
        std::fprintf(file, "}");
        separator = ",\n";
    }
    std::fprintf(file, "\n]}\n");
    if (std::fflush(file) != 0 || (file != stdout && std::fclose(file) != 0)) fail("cannot write " + path);
}

bool contains(const char* text, const std::string& part) {
    return std::strstr(text, part.c_str()) != nullptr;
}

void run_one(const Row& row, const Options& options) {
    if (options.run_code != "ours" && options.run_code != "published") fail("no code " + options.run_code);
    const Loops& l = options.run_code == "ours" ? row.ours : row.published;
    void (*loop)(int, int) = nullptr;
    for (const Measured& measured : kMeasured)
        if (measured.name == options.run_loop) loop = l.*measured.loop;
    if (!loop) fail("no loop " + options.run_loop);
    std::printf("%d times %d lights: %s, %s\n", options.run_count, kWindow, row.technique, row.lights.name);
    row.make_lights(row.lights);
    l.keep(0, kWindow);
    for (int i = 0; i < options.run_count; ++i) loop(i * kWindow % kLights, kWindow);
}

int run(const Options& options) {
    std::vector<Result> results;
    const std::vector<Row> rows = scalar_rows();
    bool counts = options.instructions;
    for (const Row& row : rows) {
        if (row.vertices > 2 && options.vertices != 0 && row.vertices != options.vertices) continue;
        if (!contains(row.technique, options.rows) && !contains(row.lights.name, options.rows)) continue;
        if (options.run_count > 0) {
            run_one(row, options);
            return 0;
        }
        row.make_lights(row.lights);
        Result result{&row, {}, {}, {}, {}};
        time_row(result, options.repetitions);
        if (counts) counts = count_row(result);
        results.push_back(result);
    }
    if (results.empty()) fail("no row contains " + options.rows);
    if (options.json != "-") print(results);
    if (options.instructions && !counts)
        std::fprintf(stderr, "Instructions cannot be counted on this machine.\n");
    if (!options.json.empty()) write_json(options.json, results);
    return 0;
}

} // namespace

} // namespace nusselt::lab

int main(int argc, char** argv) { return nusselt::lab::run(nusselt::lab::parse(argc, argv)); }
