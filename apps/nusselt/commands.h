#pragma once
/// The subcommands of `nusselt`. Each setup function adds one to the command line; its callback stores the
/// exit code in exit_code, which must live until the command line was parsed.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

/// Of line samples, whatever their number. Defaults are those of render::LineSettings.
struct LineKindOptions {
    std::optional<std::string> orientation;
    std::optional<std::string> offsets;
    std::optional<std::string> shading;
};

/// Whether there are line samples, and how. Defaults are those of render::RenderSettings.
struct LineOptions : LineKindOptions {
    std::string light_samples = "points";
    bool has_old_name = false; ///< whether they were chosen by the name of earlier versions, --integrator
    std::optional<int> count;
    std::optional<std::string> many_occluders;
};

struct RenderOptions {
    std::filesystem::path scene;
    std::vector<std::filesystem::path> rigs;     ///< in the order in which they are applied
    std::optional<std::filesystem::path> camera; ///< file with another camera
    std::vector<std::filesystem::path> outputs;  ///< empty: named after the film or the scene
    int samples = 1;
    std::string technique = "projected_solid_angle";
    std::optional<std::string> strategies;
    std::optional<std::string> mis;
    std::optional<float> visibility_estimate;
    std::string sampler = "sobol";
    std::optional<int> camera_rays;
    std::string pixel_position = "jittered";
    std::string brdf = "material";
    std::uint32_t seed = 0;
    LineOptions lines;
    std::optional<int> threads;
    std::optional<std::string> resolution; ///< "WIDTHxHEIGHT"
    double exposure = 0;
    bool quiet = false;
    std::optional<std::string> json; ///< "-" is the standard output
    std::optional<std::string> isa;
    std::vector<std::string> layers; ///< names, or "all"
    std::optional<std::string> part; ///< "NUMBER/COUNT"
    std::optional<std::filesystem::path> checkpoint;
    double checkpoint_interval = 60; ///< [s]
    std::optional<std::string> display_server;
    std::string backend = "cpu";
    std::optional<std::string> device;      ///< of the GPU: index, or part of a name
    std::optional<std::string> shadow_rays; ///< on the GPU; default: what suits the device
};

struct ViewOptions {
    RenderOptions render; ///< those of the image at first
    std::optional<std::filesystem::path> script;
};

struct CameraOptions {
    std::filesystem::path scene;
    std::optional<std::string> resolution;
};

struct MergeOptions {
    std::filesystem::path output;
    std::vector<std::filesystem::path> inputs;
};

struct ConvertOptions {
    std::filesystem::path input;
    std::optional<std::filesystem::path> output; ///< needed unless the layers are listed
    double exposure = 0;                         ///< stops
    std::optional<std::string> layer;            ///< of an EXR file; default: the picture
    bool list_layers = false;
};

/// Of benchmarks of whole frames.
struct BenchFramesOptions {
    std::filesystem::path scene;
    int samples = 1;
    int repetitions = 9;
    std::optional<int> threads;
    std::optional<std::string> resolution; ///< "WIDTHxHEIGHT"
    std::optional<std::string> isa;
};

struct BenchRaysOptions : BenchFramesOptions {
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

struct BenchStrategiesOptions : BenchFramesOptions {
    BenchStrategiesOptions() { repetitions = 15; }
};

struct BenchLinesOptions : BenchFramesOptions {
    std::vector<int> counts = {4, 16, 64}; ///< of lines per shading point and light
    LineKindOptions lines;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

struct BenchLineEfficiencyOptions {
    std::filesystem::path scene;
    std::optional<int> threads; ///< default: one, then all
    std::optional<std::string> resolution;
    std::optional<std::string> isa;
    std::string strategies = "diffuse";
    std::optional<float> roughness; ///< of all surfaces
    LineKindOptions lines;
    int most_points = 1024;
    int most_lines = 256;
    int repetitions = 5;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

struct BenchSamplersOptions {
    int repetitions = 31;
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

struct BenchGpuSamplersOptions {
    int repetitions = 15;
    std::optional<std::string> device; ///< index, or part of a name
    std::optional<std::string> json;   ///< "-" is the standard output, instead of the table
};

struct BenchGpuFramesOptions {
    std::vector<std::filesystem::path> scenes; ///< empty: all of the folder
    std::filesystem::path scene_folder = "scenes";
    std::optional<std::string> resolution = "1920x1080";
    std::vector<std::string> techniques;  ///< empty: all
    std::vector<std::string> shadow_rays; ///< ways to trace them; empty: what suits the device, and none
    int frames = 15;                      ///< of each kind
    int warm_up = 3;                      ///< frames of each kind before those
    std::optional<std::string> device;    ///< index, or part of a name
    std::optional<std::string> json;      ///< "-" is the standard output, instead of the table
};

struct BenchAccuracyOptions {
    int count = 5000; ///< of docs/accuracy.json: the test that compares with it takes a quarter of a minute
    std::optional<std::string> isa;
    std::optional<std::filesystem::path> markdown;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

struct BenchWorstCaseOptions {
    std::vector<std::string> targets; ///< empty: all
    std::optional<double> seconds;
    std::optional<std::uint64_t> starts; ///< per target, those in the state file included
    std::optional<std::uint64_t> seed;
    std::optional<int> threads;
    std::optional<std::filesystem::path> state;
    int convergence = 2000;          ///< random lights for the order of convergence
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

struct MapOptions {
    std::string technique; ///< class name
    std::filesystem::path output;
};

struct BenchFuzzOptions {
    std::vector<std::string> techniques; ///< empty: all
    std::string scalar = "float";
    std::uint64_t seed = 1;
    std::uint64_t first = 0;
    std::uint64_t count = 10'000'000;
    std::optional<int> threads;
    std::optional<std::string> isa;
};

struct BenchShadowsOptions {
    std::uint64_t seed = 1;
    std::uint64_t first = 0;
    std::uint64_t count = 625'000;
    std::optional<int> threads;
    std::optional<std::string> isa;
};

struct BenchTubesOptions {
    int repetitions = 31;
};

struct BenchPhongLinesOptions {
    int repetitions = 31;
    std::optional<std::string> isa;
};

struct BenchScaleOptions {
    std::uint64_t triangles = 10'000'000;
    std::uint64_t emissive = 100'000;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

struct FitLtcOptions {
    std::string brdf = "frostbite-specular";
    std::string size = "64x64x51"; ///< roughness, inclination, f0
    std::string output;            ///< without extension
    std::optional<std::filesystem::path> checkpoint;
    std::string commit = "unknown";
    std::optional<int> threads;
};

struct ReproduceOptions {
    std::vector<std::string> experiments; ///< empty: all
    std::filesystem::path output = "out/reproduce";
    std::filesystem::path scenes = "scenes";
    int reference_samples = 0; ///< 0: as the experiments say
    int width = 0;             ///< of the images in pixels; 0: as the scenes say
    std::optional<int> threads;
};

void setup_render(CLI::App& app, int& exit_code);
void setup_view(CLI::App& app, int& exit_code);
void setup_merge(CLI::App& app, int& exit_code);
void setup_camera(CLI::App& app, int& exit_code);
void setup_techniques(CLI::App& app, int& exit_code);
void setup_convert(CLI::App& app, int& exit_code);
void setup_bench(CLI::App& app, int& exit_code);
void setup_reproduce(CLI::App& app, int& exit_code);
void setup_map(CLI::App& app, int& exit_code);
void setup_fit_ltc(CLI::App& app, int& exit_code);

// Below `bench`.
void setup_bench_rays(CLI::App& bench, int& exit_code);
void setup_bench_strategies(CLI::App& bench, int& exit_code);
void setup_bench_lines(CLI::App& bench, int& exit_code);
void setup_bench_line_efficiency(CLI::App& bench, int& exit_code);
void setup_bench_samplers(CLI::App& bench, int& exit_code);
void setup_bench_gpu_samplers(CLI::App& bench, int& exit_code);
void setup_bench_gpu_frames(CLI::App& bench, int& exit_code);
void setup_bench_accuracy(CLI::App& bench, int& exit_code);
void setup_bench_worst_case(CLI::App& bench, int& exit_code);
void setup_bench_fuzz(CLI::App& bench, int& exit_code);
void setup_bench_shadows(CLI::App& bench, int& exit_code);
void setup_bench_tubes(CLI::App& bench, int& exit_code);
void setup_bench_scale(CLI::App& bench, int& exit_code);
void setup_bench_phong_lines(CLI::App& bench, int& exit_code);

/// Renders and writes the images.
/// \returns 0, or 130 if it was interrupted
int run_render(const RenderOptions& options);

/// Shows a scene in a window until that is closed.
int run_view(const ViewOptions& options);

/// Puts images of parts or seeds together.
int run_merge(const MergeOptions& options);

/// Converts an image to another format, or prints the layers of an EXR file.
int run_convert(const ConvertOptions& options);

/// Prints the camera of a scene.
int run_camera(const CameraOptions& options);

/// Prints the table of techniques.
int run_techniques();

/// Compares the time of rendering with that of tracing the same rays.
int run_bench_rays(const BenchRaysOptions& options);

/// Measures what a second technique for the specular component costs.
int run_bench_strategies(const BenchStrategiesOptions& options);

/// Measures what line samples cost, in shadow rays.
int run_bench_lines(const BenchLinesOptions& options);

/// Measures how long line samples and point samples take to the same error.
int run_bench_line_efficiency(const BenchLineEfficiencyOptions& options);

/// Measures the cost of each technique and prints or writes the table.
int run_bench_samplers(const BenchSamplersOptions& options);

/// Measures the cost of each technique on a GPU and prints or writes the table.
int run_bench_gpu_samplers(const BenchGpuSamplersOptions& options);

/// Measures frames of scenes with each technique on a GPU and prints or writes the table.
/// \returns 0, or 1 if a scene could not be measured
int run_bench_gpu_frames(const BenchGpuFramesOptions& options);

/// Measures the accuracy of each technique and prints or writes the tables.
int run_bench_accuracy(const BenchAccuracyOptions& options);

/// Searches for the largest errors of the iterations and prints or writes them.
/// \returns 0, 1 if one is above its documented bound, or 130 if the search was interrupted
int run_bench_worst_case(const BenchWorstCaseOptions& options);

/// Draws the map of a technique.
int run_map(const MapOptions& options);

/// Fits a table of linearly transformed cosines and prints the distribution of its errors.
/// \returns 0, or 130 if it was interrupted
int run_fit_ltc(const FitLtcOptions& options);

/// Runs techniques on hostile lights and prints what breaks their contract.
/// \returns 0, or 1 if anything does
int run_bench_fuzz(const BenchFuzzOptions& options);
int run_bench_shadows(const BenchShadowsOptions& options);

/// Measures noise and cost of sampling cylinders and prints the table.
int run_bench_tubes(const BenchTubesOptions& options);

/// Measures Phong lobes along lines and prints the table.
int run_bench_phong_lines(const BenchPhongLinesOptions& options);

/// Measures time and memory of large scenes and prints or writes the tables.
int run_bench_scale(const BenchScaleOptions& options);

/// Runs experiments, prints their tables and writes a page for each.
/// \returns 0, or 1 if an expectation does not hold
int run_reproduce(const ReproduceOptions& options);

} // namespace nusselt::app
