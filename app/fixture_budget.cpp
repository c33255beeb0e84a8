#include "app/fixture_budget.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "app/budget_record.h"
#include "engine/job/budget_job.h"
#include "engine/job/input_codes.h"
#include "engine/job/input_text.h"
#include "gum/budget/budget_covariance.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::app {

namespace {

using engine::RotaryTableJob;
using gum::Diagnostic;
using gum::InputGroup;
using gum::k_micrometre;

constexpr double k_greatest_difference = 0.1e-6;  // of a coordinate between budget and file, [m]
constexpr double k_greatest_ratio = 2.0;          // of its standard uncertainties, before it is worth a warning

std::string code(const engine::InputCode& input_code) {
    return std::string(input_code.code);
}

bool same_distribution(const gum::Distribution& a, const gum::Distribution& b) {
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
    group.covariance = u * u.transpose();
    group.dependence = gum::Dependence::same_probability;
    return group;
}

void check_output(const RotaryTableJob& job, const gum::BudgetResult& result) {
    const gum::Dimension length = gum::Unit::parse("m").dimension();
    if (result.output_names.size() == 1 && result.output_units.front().dimension() == length) {
        return;
    }
    std::string found;
    for (std::size_t i = 0; i < result.output_names.size(); ++i) {
        found += (i == 0 ? "" : ", ") + result.output_names[i] + " [" + result.output_units[i].text() + "]";
    }
    throw gum::InputError(Diagnostic{.code = code(engine::k_fixture_budget_output),
                                     .where = job.fixture_budget_file + "#/outputs",
                                     .what = "the results are " + found,
                                     .rule = "the budget of the fixture has one output, a length",
                                     .action = "State one output with a unit of length, such as um."});
}

/// The budget with its points in the order x1 y1 z1 x2 …; the reader has matched their names.
engine::BudgetJob in_order_of_coordinates(const RotaryTableJob& job) {
    std::unordered_map<std::string, std::size_t> places;
    for (const std::string& reflector : job.measurement.reflectors) {
        for (std::size_t k = 0; k < 3; ++k) {
            places.emplace(engine::fixture_coordinate_name(reflector, k), places.size());
        }
    }
    engine::BudgetJob budget = *job.fixture_budget;
    std::sort(budget.points.begin(), budget.points.end(),
              [&](const auto& a, const auto& b) { return places.at(a.name) < places.at(b.name); });
    // Monte Carlo of the budget alone would not be looked at: the job draws its inputs together with all others.
    budget.monte_carlo.reset();
    return budget;
}

void check_values(const RotaryTableJob& job, const engine::BudgetJob& budget, const gum::BudgetResult& result) {
    std::vector<Diagnostic> problems;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const auto at = static_cast<Eigen::Index>(p);
        const double stated = job.measurement.fixture(at / 3, at % 3);
        const double value = result.points[p].propagation.value(0);
        if (!(std::abs(value - stated) <= k_greatest_difference)) {
            problems.push_back({.code = code(engine::k_fixture_budget_differs),
                                .where = job.fixture_budget_file + "#/points",
                                .what = budget.points[p].name + " is " + text::shortest_plain(value * 1e3) +
                                        " mm in the budget and " + text::shortest_plain(stated * 1e3) +
                                        " mm in the coordinates file",
                                .rule = "both state the same coordinate, within 0.1 µm",
                                .action = "Correct whichever is wrong."});
        }
    }
    if (!problems.empty()) {
        throw gum::InputError(std::move(problems));
    }
}

void warn_of_columns(const RotaryTableJob& job, const Eigen::MatrixXd& covariance, std::vector<Diagnostic>& notes) {
    double largest = 1.0;
    Eigen::Index at = 0;
    for (Eigen::Index i = 0; i < job.stated_fixture_u.size(); ++i) {
        const double stated = job.stated_fixture_u(i);
        const double u = std::sqrt(covariance(i, i));
        const double ratio = stated > 0.0 ? std::max(u / stated, stated / u) : 1.0;
        if (ratio > largest) {
            largest = ratio;
            at = i;
        }
    }
    if (largest <= k_greatest_ratio) {
        return;
    }
    const std::string& reflector = job.measurement.reflectors[static_cast<std::size_t>(at / 3)];
    notes.push_back({.code = code(engine::k_warn_fixture_u_differs),
                     .where = "fixture coordinates",
                     .what = "u of " + engine::fixture_coordinate_name(reflector, static_cast<std::size_t>(at % 3)) +
                             " is " + text::shortest_plain(job.stated_fixture_u(at) / k_micrometre) +
                             " µm in the coordinates file",
                     .rule = "the column is not used; what is used instead differs by more than a factor of 2",
                     .action = "Find out which of the two is right.",
                     .severity = gum::Severity::warning});
}

void evaluate(RotaryTableJob& job, FixtureUncertainty& fixture) {
    const engine::BudgetJob budget = in_order_of_coordinates(job);
    const gum::BudgetResult& result = fixture.budget.emplace(gum::evaluate_budget(budget, 1));
    check_output(job, result);
    check_values(job, budget, result);
    const Eigen::MatrixXd covariance = gum::budget_covariance(result);
    std::vector<std::string> names;
    Eigen::Index largest = 0;
    for (Eigen::Index p = 0; p < covariance.rows(); ++p) {
        const std::string& name = names.emplace_back(budget.points[static_cast<std::size_t>(p)].name);
        if (!(covariance(p, p) > 0.0)) {
            throw gum::NoResultError(Diagnostic{.code = "GC-FIXTURE-0002",
                                                .where = job.fixture_budget_file + "#/points",
                                                .what = "the standard uncertainty of " + name + " is 0 µm",
                                                .rule = "a measured coordinate has an uncertainty",
                                                .action = "State it in the budget."});
        }
        if (covariance(p, p) > covariance(largest, largest)) {
            largest = p;
        }
    }
    job.measurement.fixture_covariance = covariance;
    fixture.model = std::make_shared<const JointBudgetModel>(result, names);

    reports::FixtureBudget& record = fixture.record;
    record.method = "budget";
    record.file = job.fixture_budget_file;
    record.largest_coordinate = names[static_cast<std::size_t>(largest)];
    reports::EvaluationRecord of_budget = budget_record(budget, result, {}, {}, "");
    record.largest = std::move(of_budget.results[static_cast<std::size_t>(largest)].budget);
    record.remarks.emplace_back(
        "The coordinates are correlated through the input quantities that their budgets have in common; the adjustment "
        "uses the full covariance.");
    fixture.notes = result.notes;
}

}  // namespace

JointBudgetModel::JointBudgetModel(const gum::BudgetResult& result, const std::vector<std::string>& names) {
    // Groups in the order in which the points first bring them, so that the result depends on the job alone.
    std::vector<SharedInput> shared;
    std::unordered_map<std::uint64_t, std::size_t> by_stream;
    struct Use {
        std::size_t input = 0, variant = 0;
    };
    std::vector<std::vector<Use>> uses;
    for (const gum::BudgetPointResult& point : result.points) {
        std::vector<Use>& of_point = uses.emplace_back();
        for (std::size_t g = 0; g < point.streams.size(); ++g) {
            const InputGroup& group = point.model->inputs()[g];
            const auto [entry, is_new] = by_stream.try_emplace(point.streams[g], shared.size());
            if (is_new) {
                shared.push_back({.group = group, .variants = {group}});
            }
            std::vector<InputGroup>& variants = shared[entry->second].variants;
            const auto same = std::find_if(variants.begin(), variants.end(),
                                           [&](const InputGroup& variant) { return same_group(variant, group); });
            of_point.push_back({entry->second, static_cast<std::size_t>(same - variants.begin())});
            if (same != variants.end()) {
                continue;
            }
            if (group.size() > 1 || shared[entry->second].group.size() > 1) {
                throw gum::NoResultError(
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

FixtureUncertainty apply_fixture_budget(RotaryTableJob& job) {
    FixtureUncertainty fixture;
    reports::FixtureBudget& record = fixture.record;
    record.method = "stated";
    if (job.source_paper_fixture) {
        record.method = "source_paper";
        record.remarks = {
            "Standard uncertainty of each coordinate L by equation (11) of the source paper, "
            "sqrt(0.401² + (3.32·10⁻⁷ L)²) µm with L in µm, uncorrelated; U = 2 u_c by its equation (12). It is used "
            "on request, to reproduce the paper.",
            "The terms 3.12·10⁻⁷ L and 1.176·10⁻⁷ L that the paper states combine to 3.334·10⁻⁷ L, not to 3.32·10⁻⁷ L.",
            "The maximum permissible error of the coordinate measuring machine is used as a standard uncertainty; as a "
            "bound of a uniform distribution it would be divided by the square root of 3.",
            "The square of 0.4 + 1.176·10⁻⁷ L is taken without its cross term."};
    } else if (job.fixture_budget) {
        evaluate(job, fixture);
    }
    warn_of_columns(job, job.measurement.fixture_covariance, fixture.notes);
    return fixture;
}

}  // namespace gumcert::app
