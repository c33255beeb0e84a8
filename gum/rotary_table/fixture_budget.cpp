#include "gum/rotary_table/fixture_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "gum/budget/budget_covariance.h"
#include "gum/quantity/units.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {

namespace {

constexpr double k_greatest_difference = 0.1e-6;  // of a coordinate between budget and file, [m]
constexpr double k_greatest_ratio = 2.0;          // of its standard uncertainties, before it is worth a warning

bool same_distribution(const Distribution& a, const Distribution& b) {
    return a.kind == b.kind && a.location == b.location && a.scale == b.scale && a.shape == b.shape &&
           a.second_shape == b.second_shape && a.samples == b.samples;
}

bool same_group(const InputGroup& a, const InputGroup& b) {
    return a.size() == b.size() && a.value == b.value && a.covariance == b.covariance &&
           std::equal(a.marginals.begin(), a.marginals.end(), b.marginals.begin(), b.marginals.end(),
                      same_distribution);
}

/// One input of the points with the group in which each point sees it.
struct SharedInput {
    InputGroup group;
    std::vector<InputGroup> variants;  ///< of one quantity, different from each other; the first one is `group`
    Eigen::Index first = 0;
};

/// A group of all variants of one quantity: they take the quantile of one probability.
InputGroup group_of_variants(const std::vector<InputGroup>& variants) {
    InputGroup group = variants.front();
    const auto n = static_cast<Eigen::Index>(variants.size());
    Eigen::VectorXd u(n);
    group.value.resize(n);
    group.marginals.clear();
    for (Eigen::Index i = 0; i < n; ++i) {
        const InputGroup& variant = variants[static_cast<std::size_t>(i)];
        group.value(i) = variant.value(0);
        u(i) = std::sqrt(variant.covariance(0, 0));
        group.marginals.push_back(variant.marginals.front());
    }
    // One probability for all: correlation 1, of rank one.
    group.covariance = u * u.transpose();
    group.dependence = Dependence::same_probability;
    return group;
}

void check_output(const RotaryTableRequest& request, const BudgetResult& result) {
    const Dimension length = Unit::parse("m").dimension();
    const std::vector<BudgetOutputResult>& outputs = result.points.front().outputs;
    if (outputs.size() == 1 && outputs.front().unit.dimension() == length) {
        return;
    }
    std::string found;
    for (const BudgetOutputResult& output : outputs) {
        found += (found.empty() ? "" : ", ") + output.name + " [" + output.unit.text() + "]";
    }
    throw InputError(Diagnostic{.code = "GC-INPUT-0230",
                                .where = request.fixture_budget_file + "#/outputs",
                                .what = "the results are " + found,
                                .rule = "the budget of the fixture has one output, a length",
                                .action = "State one output with a unit of length, such as um."});
}

void check_values(const RotaryTableRequest& request, const Budget& budget, const BudgetResult& result) {
    std::vector<Diagnostic> problems;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const auto at = static_cast<Eigen::Index>(p);
        const double stated = request.measurement.fixture(at / 3, at % 3);
        const double value = result.points[p].propagation.value(0);
        // Two sources of one coordinate: a difference of more than a tenth of a micrometre is another fixture, or
        // another order of the points. Written so that a NaN is reported.
        if (!(std::abs(value - stated) <= k_greatest_difference)) {
            problems.push_back({.code = "GC-INPUT-0231",
                                .where = request.fixture_budget_file + "#/points",
                                .what = budget.points[p].name + " is " + text::shortest_plain(value * 1e3) +
                                        " mm in the budget and " + text::shortest_plain(stated * 1e3) +
                                        " mm in the coordinates file",
                                .rule = "both state the same coordinate, within 0.1 µm",
                                .action = "Correct whichever is wrong."});
        }
    }
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }
}

void warn_of_columns(const RotaryTableRequest& request, const Eigen::MatrixXd& covariance,
                     std::vector<Diagnostic>& notes) {
    double largest = 1.0;
    Eigen::Index at = 0;
    for (Eigen::Index i = 0; i < request.stated_fixture_u.size(); ++i) {
        const double stated = request.stated_fixture_u(i);
        const double u = std::sqrt(covariance(i, i));
        // Too small misleads as much as too large.
        const double ratio = stated > 0.0 ? std::max(u / stated, stated / u) : 1.0;
        if (ratio > largest) {
            largest = ratio;
            at = i;
        }
    }
    if (largest <= k_greatest_ratio) {
        return;
    }
    const std::string& reflector = request.measurement.reflectors[static_cast<std::size_t>(at / 3)];
    notes.push_back({.code = "GC-WARN-0012",
                     .where = "fixture coordinates",
                     .what = "u of " + fixture_coordinate_name(reflector, static_cast<std::size_t>(at % 3)) + " is " +
                             text::shortest_plain(request.stated_fixture_u(at) / k_micrometre) +
                             " µm in the coordinates file",
                     .rule = "the column is not used; what is used instead differs by more than a factor of 2",
                     .action = "Find out which of the two is right.",
                     .severity = Severity::warning});
}

void evaluate(RotaryTableRequest& request, FixtureUncertainty& fixture) {
    Budget budget = *request.fixture_budget;
    budget.points =
        in_order_of_coordinates(std::move(budget.points), request.measurement.reflectors, request.fixture_budget_file);
    // Monte Carlo of the budget alone would not be looked at: its inputs are drawn together with all others.
    budget.monte_carlo.reset();
    const BudgetResult& result = fixture.budget.emplace(evaluate_budget(budget, 1));
    check_output(request, result);
    check_values(request, budget, result);
    // With what the coordinates share (CMM, temperature, expansion) off the diagonal: six reflectors that are all wrong
    // alike are not six independent ones.
    const Eigen::MatrixXd covariance = budget_covariance(result);
    std::vector<std::string> names;
    Eigen::Index largest = 0;
    for (Eigen::Index p = 0; p < covariance.rows(); ++p) {
        const std::string& name = names.emplace_back(budget.points[static_cast<std::size_t>(p)].name);
        if (!(covariance(p, p) > 0.0)) {
            throw NoResultError(Diagnostic{.code = "GC-FIXTURE-0002",
                                           .where = request.fixture_budget_file + "#/points",
                                           .what = "the standard uncertainty of " + name + " is 0 µm",
                                           .rule = "a measured coordinate has an uncertainty",
                                           .action = "State it in the budget."});
        }
        if (covariance(p, p) > covariance(largest, largest)) {
            largest = p;
        }
    }
    request.measurement.fixture_covariance = covariance;
    fixture.largest = static_cast<std::size_t>(largest);
    fixture.model = std::make_shared<const JointBudgetModel>(result, names);
    fixture.notes = result.notes;
}

}  // namespace

JointBudgetModel::JointBudgetModel(const BudgetResult& result, const std::vector<std::string>& names) {
    // Groups in the order in which the points first bring them, so that the result depends on the job alone.
    std::vector<SharedInput> shared;
    // Equal streams are what points have in common (budget_inputs): a name would not do, since one name may stand for
    // an input of each point.
    std::unordered_map<std::uint64_t, std::size_t> by_stream;
    struct Use {
        std::size_t input = 0, variant = 0;
    };
    std::vector<std::vector<Use>> uses;
    for (const BudgetPointResult& point : result.points) {
        std::vector<Use>& of_point = uses.emplace_back();
        for (std::size_t g = 0; g < point.streams.size(); ++g) {
            const InputGroup& group = point.model->inputs()[g];
            const auto [entry, is_new] = by_stream.try_emplace(point.streams[g], shared.size());
            if (is_new) {
                shared.push_back({.group = group, .variants = {group}});
            }
            std::vector<InputGroup>& variants = shared[entry->second].variants;
            // A percentage of the reading is another distribution at each point, of the same cause: a variant, not a
            // new input.
            const auto same = std::find_if(variants.begin(), variants.end(),
                                           [&](const InputGroup& variant) { return same_group(variant, group); });
            of_point.push_back({entry->second, static_cast<std::size_t>(same - variants.begin())});
            if (same != variants.end()) {
                continue;
            }
            if (group.size() > 1 || shared[entry->second].group.size() > 1) {
                throw NoResultError(
                    Diagnostic{.code = "GC-FIXTURE-0001",
                               .where = "inputs " + group.name,
                               .what = "correlated with each other, common to all points, and different between them",
                               .rule = "the joint distribution of such inputs at several points is not known",
                               .action = "State inputs that are the same at all points, or a covariance file."});
            }
            variants.push_back(group);
        }
    }
    for (SharedInput& input : shared) {
        input.first = size_;
        groups_.push_back(input.variants.size() == 1 ? std::move(input.group) : group_of_variants(input.variants));
        size_ += groups_.back().size();
    }
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        Point point{.model = result.points[p].model, .inputs = {}};
        for (std::size_t g = 0; g < uses[p].size(); ++g) {
            // A variant is one column of its group; a group of several quantities has one variant only, see above.
            const Eigen::Index first = shared[uses[p][g].input].first + static_cast<Eigen::Index>(uses[p][g].variant);
            for (Eigen::Index i = 0; i < point.model->inputs()[g].size(); ++i) {
                point.inputs.push_back(first + i);
            }
        }
        points_.push_back(std::move(point));
        outputs_.push_back({names[p], result.points[p].model->outputs().front().unit});
    }
}

Eigen::VectorXd JointBudgetModel::evaluate(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y(static_cast<Eigen::Index>(points_.size()));
    // Each point sees its own columns of the joint inputs.
    for (std::size_t p = 0; p < points_.size(); ++p) {
        y(static_cast<Eigen::Index>(p)) = points_[p].model->evaluate(x(points_[p].inputs))(0);
    }
    return y;
}

Eigen::MatrixXd JointBudgetModel::jacobian(const Eigen::VectorXd& x) const {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points_.size()), size_);
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const Eigen::MatrixXd of_point = points_[p].model->jacobian(x(points_[p].inputs));
        for (std::size_t i = 0; i < points_[p].inputs.size(); ++i) {
            J(static_cast<Eigen::Index>(p), points_[p].inputs[i]) = of_point(0, static_cast<Eigen::Index>(i));
        }
    }
    return J;
}

void JointBudgetModel::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x,
                                       Eigen::Ref<Eigen::MatrixXd> y) const {
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const Eigen::MatrixXd of_point = x(Eigen::all, points_[p].inputs);
        points_[p].model->evaluate_trials(of_point, y.col(static_cast<Eigen::Index>(p)));
    }
}

// Kept as printed. The terms of the paper combine to 3.334e-7, its maximum permissible error stands for a standard
// uncertainty, and a cross term is dropped (docs/rotary_table_job.md).
double source_paper_fixture_uncertainty(double coordinate) {
    constexpr double k_constant = 0.401 * k_micrometre;
    constexpr double k_proportional = 3.32e-7;  // L and u_c in the same unit
    return std::hypot(k_constant, k_proportional * coordinate);
}

std::string fixture_coordinate_name(const std::string& reflector, std::size_t axis) {
    static constexpr std::array<const char*, 3> k_suffixes{".x", ".y", ".z"};
    return reflector + k_suffixes[axis];
}

std::vector<BudgetPoint> in_order_of_coordinates(std::vector<BudgetPoint> points,
                                                 const std::vector<std::string>& reflectors, const std::string& file) {
    std::unordered_map<std::string, std::size_t> found;
    for (std::size_t p = 0; p < points.size(); ++p) {
        found.emplace(points[p].name, p);
    }
    std::vector<BudgetPoint> in_order;
    for (std::size_t i = 0; i < 3 * reflectors.size(); ++i) {
        const std::string name = fixture_coordinate_name(reflectors[i / 3], i % 3);
        const auto point = found.find(name);
        if (point == found.end() || points.size() != 3 * reflectors.size()) {
            throw InputError(Diagnostic{.code = "GC-FIXTURE-0003",
                                        .where = file + "#/points",
                                        .what = point == found.end()
                                                    ? "the coordinate " + name + " has no point"
                                                    : text::count_of(points.size(), "point") + " for " +
                                                          std::to_string(3 * reflectors.size()) + " coordinates",
                                        .rule = "the budget of the fixture has one point for each coordinate",
                                        .action = "State one point for each coordinate, named as R1.x."});
        }
        in_order.push_back(std::move(points[point->second]));
        found.erase(point);
    }
    return in_order;
}

FixtureUncertainty apply_fixture_budget(RotaryTableRequest& request) {
    FixtureUncertainty fixture;
    if (request.fixture_budget) {
        evaluate(request, fixture);
    }
    warn_of_columns(request, request.measurement.fixture_covariance, fixture.notes);
    return fixture;
}

}  // namespace gumcert::gum
