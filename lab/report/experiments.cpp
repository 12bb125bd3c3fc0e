#include "lab/report/experiment.h"

#include "lab/accuracy/accuracy_experiment.h"
#include "lab/figures/error_images.h"
#include "lab/figures/map_experiment.h"
#include "lab/figures/noise_table.h"
#include "lab/figures/run_image_comparison.h"
#include "lab/fuzzing/worst_case_experiment.h"
#include "lab/lines/line_convergence.h"
#include "lab/lines/line_growth.h"
#include "lab/lines/line_visibility.h"
#include "lab/peers/peer_comparison.h"
#include "lab/round/round_comparison.h"
#include "lab/statements/statement_set.h"
#include "lab/timing/cost_experiments.h"
#include "lab/tubes/light_costs.h"
#include "lab/tubes/light_grid.h"

namespace nusselt::lab {

namespace {

/// Kinds that need nothing but this program and files of the repository have no function of their own.
template <class Kind>
std::string obstacle(const Kind& /*any*/) {
    return "";
}

/// Experiments of one kind. A kind has a name, a source and a description, and these functions for it: quick() reduces
/// the effort, `run` measures, and report_of() reports what that returns. obstacle() may say what the machine lacks.
template <class Kind, class Run>
void add(const std::vector<Kind>& kinds, const Run& run, std::vector<Experiment>& experiments) {
    for (const Kind& kind : kinds)
        experiments.push_back({kind.name, kind.source, kind.description,
                               [&kind, run](const RunSettings& settings, const ProgressText& progress) {
                                   const Kind chosen = settings.effort == Effort::quick ? quick(kind) : kind;
                                   return report_of(run(chosen, settings, progress));
                               },
                               [&kind] { return obstacle(kind); }});
}

} // namespace

const std::vector<Experiment>& all_experiments() {
    static const std::vector<Experiment> experiments = [] {
        std::vector<Experiment> all;
        add(all_image_comparisons(), run_image_comparison, all);
        add(all_noise_tables(), run_noise_table, all);
        add(all_error_images(), run_error_images, all);
        add(all_map_sets(), run_map_set, all);
        add(all_accuracy_studies(), run_accuracy_study, all);
        add(all_worst_case_studies(), run_worst_case_study, all);
        add(all_statement_sets(), run_statement_set, all);
        add(all_cost_tables(), run_cost_table, all);
        add(all_line_convergences(), run_line_convergence, all);
        add(all_line_visibilities(), run_line_visibility, all);
        add(all_line_growths(), run_line_growth, all);
        add(all_light_grids(), run_light_grid, all);
        add(all_light_costs(), run_light_costs, all);
        add(all_peer_comparisons(), run_peer_comparison, all);
        add(all_round_comparisons(), run_round_comparison, all);
        return all;
    }();
    return experiments;
}

} // namespace nusselt::lab
