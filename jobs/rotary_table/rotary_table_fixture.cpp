#include "jobs/rotary_table/rotary_table_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"
#include "gum/rotary_table/fixture_budget.h"
#include "jobs/budget/budget_job.h"
#include "jobs/job_limits.h"
#include "jobs/job_reader.h"
#include "jobs/rotary_table/rotary_table_fields.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::k_micrometre;
using gum::k_millimetre;

/// The uncertainty of the fixture comes from one place: columns, covariance, budget or the equation of the paper.
void refuse_second_uncertainty(const JsonObject& fixture, const RotaryTableJob& job) {
    std::vector<std::pair<std::string_view, std::string>> sources;
    if (job.source_paper_fixture) {
        sources.emplace_back("uncertainty", "\"uncertainty\": \"source_paper\"");
    }
    for (const std::string_view key : {"covariance", "budget"}) {
        if (fixture.has(key)) {
            sources.emplace_back(key, text::in_quotes(key));
        }
    }
    if (job.measurement.fixture_shape == engine::InputShape::uniform) {
        sources.emplace_back("distribution", "\"distribution\": \"uniform\"");
    }
    for (std::size_t i = 1; i < sources.size(); ++i) {
        const bool is_shape = sources[i].first == "distribution";
        fixture.refuse(k_fixture_keys_exclude, sources[i].first,
                       sources[i].second + " is given beside " + sources.front().second,
                       is_shape ? "a uniform distribution belongs to uncorrelated coordinates with the standard "
                                  "uncertainties of the coordinates file"
                                : "the uncertainty of the fixture comes from a covariance, a budget or the "
                                  "source paper",
                       "keep one of them");
    }
}

std::string where_in_row(const std::string& file, Eigen::Index row) {
    return text::visible(file) + " (row " + std::to_string(row + 1) + ")";
}

void check_points(const BudgetJob& budget, const FixtureNames& fixture, ProblemList& problems) {
    const std::string where = text::visible(problems.file()) + "#/points";
    std::vector<std::string> expected;
    for (const std::string& reflector : fixture.reflectors.names()) {
        for (std::size_t k = 0; k < 3; ++k) {
            expected.push_back(gum::fixture_coordinate_name(reflector, k));
        }
    }
    const std::string rule = "the budget of the fixture has one point for each coordinate, \"" + expected.front() +
                             "\" to \"" + expected.back() + "\"";
    if (budget.points.empty()) {
        problems.refuse(k_fixture_budget_points, where, "the budget has no points", rule, "add \"points\"");
        return;
    }
    std::vector<std::string> stated;
    for (const gum::BudgetPoint& point : budget.points) {
        stated.push_back(point.name);
    }
    std::vector<std::string> sorted_expected = expected;
    std::vector<std::string> sorted_stated = stated;
    std::sort(sorted_expected.begin(), sorted_expected.end());
    std::sort(sorted_stated.begin(), sorted_stated.end());
    for (const std::string& name : expected) {
        if (!std::binary_search(sorted_stated.begin(), sorted_stated.end(), name)) {
            problems.refuse(k_fixture_budget_points, where, "the coordinate " + text::in_quotes(name) + " has no point",
                            rule, "add the point, or correct its name");
        }
    }
    for (const std::string& name : stated) {
        if (!std::binary_search(sorted_expected.begin(), sorted_expected.end(), name)) {
            problems.refuse(k_fixture_budget_points, where,
                            "the point " + text::in_quotes(name) + " is no coordinate of the fixture file", rule,
                            "remove the point, or correct its name");
        }
    }
}

}  // namespace

void read_fixture_statement(const RotaryTableReading& reading, const JsonObject& fixture, bool has_environment) {
    RotaryTableJob& job = reading.job();
    FixtureStatement& stated = reading.stated.fixture;
    JobReader reader(fixture);
    reader.read(stated, {"reference_temperature_degC"});
    if (has_environment) {
        fixture.require("thermal_expansion_per_K");
    }
    reader.read(stated, {"thermal_expansion_per_K"});
    reader.read(stated, {"variance_component"});
    reader.read(stated, {"distribution"});
    reader.read(stated, {"uncertainty"});
    job.reference_temperature_degC = stated.reference_temperature_degC;
    if (stated.expansion) {
        job.measurement.expansion = stated.expansion->value;
        job.measurement.u_expansion = stated.expansion->u;
        job.measurement.expansion_shape = stated.expansion->shape;
    }
    job.measurement.fixture_component = stated.component;
    job.measurement.fixture_shape = stated.shape;
    job.source_paper_fixture = stated.source_paper;
    reading.stated.has_fixture_budget = fixture.has("budget");
    refuse_second_uncertainty(fixture, job);
}

FixtureNames read_fixture(const RotaryTableReading& reading, JobFiles::File&& file) {
    RotaryTableJob& job = reading.job();
    FixtureNames names;
    const bool u_is_elsewhere = reading.stated.fixture.source_paper || reading.stated.has_fixture_budget;
    enum : std::size_t { reflector, x, u_x = 4 };
    static constexpr std::array<std::string_view, 7> k_columns{"reflector", "x_mm",   "y_mm",  "z_mm",
                                                               "u_x_um",    "u_y_um", "u_z_um"};
    const std::span<const std::string_view> columns(k_columns);
    names.table = u_is_elsewhere
                      ? read_csv_table(std::move(file.bytes), columns.first(u_x), columns.subspan(u_x), *file.problems)
                      : read_csv_table(std::move(file.bytes), columns, {}, *file.problems);
    if (!names.table) {
        return names;
    }
    const CsvTable& table = *names.table;
    if (table.rows() > k_most_reflectors) {
        file.problems->refuse(k_too_many_reflectors, table.where(table.cell(k_most_reflectors, reflector)),
                              counted(table.rows(), "reflector"),
                              "a fixture has at most " + std::to_string(k_most_reflectors) + " reflectors",
                              "check that the file is the fixture file");
        return names;
    }
    const auto count = static_cast<Eigen::Index>(table.rows());
    Eigen::MatrixX3d coordinates = Eigen::MatrixX3d::Zero(count, 3);
    Eigen::VectorXd stated_u = Eigen::VectorXd::Zero(3 * count);
    std::vector<std::size_t> lines;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto r = static_cast<Eigen::Index>(row);
        if (const auto name = table.name(row, reflector)) {
            const std::size_t line = table.cell(row, reflector).line;
            if (const auto known = names.reflectors.find(*name)) {
                refuse_repeated_name(table, row, reflector, "reflector", lines[*known], *file.problems);
            } else {
                names.reflectors.index(*name);
                lines.push_back(line);
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto column = static_cast<Eigen::Index>(k);
            coordinates(r, column) = table.number(row, x + k, k_fixture_coordinate).value_or(0.0);
            const auto u = u_is_elsewhere ? table.number_if_any(row, u_x + k, above_zero("µm"))
                                          : table.number(row, u_x + k, above_zero("µm"));
            stated_u(3 * r + column) = u.value_or(0.0) * k_micrometre;
        }
    }
    if (file.problems->refusals() > 0) {
        return names;
    }
    if (coordinates.cwiseAbs().maxCoeff() < 1.0) {
        file.problems->refuse(k_coordinates_in_metres, table.where(table.cell(0, x)),
                              "no coordinate reaches 1 mm; the largest is " +
                                  text::shortest_plain(coordinates.cwiseAbs().maxCoeff()) + " mm",
                              "coordinates are in millimetres", "multiply by 1000 if the values are metres");
    }
    job.measurement.reflectors = names.reflectors.names();
    job.measurement.fixture = coordinates * k_millimetre;
    // Of the best CMM it is some 0.1 µm. What is stated far below makes chance an accusation, and the set-up too well known.
    constexpr double k_unlikely = 0.01;  // [µm]
    if (const double largest = stated_u.maxCoeff() / k_micrometre; largest > 0.0 && largest < k_unlikely) {
        file.problems->warn(
            k_warn_unlikely_uncertainty, table.where(table.cell(0, u_x)),
            "the largest standard uncertainty of a coordinate is " + text::significant(largest, 2) + " µm",
            "a coordinate of a fixture is hardly known to " + text::shortest_plain(k_unlikely) + " µm",
            "check the unit: the columns u_x_um, u_y_um and u_z_um are in micrometres");
    }
    if (!u_is_elsewhere) {
        job.measurement.fixture_covariance = stated_u.array().square().matrix().asDiagonal();
    } else {
        Eigen::VectorXd variances = Eigen::VectorXd::Zero(3 * count);
        for (Eigen::Index i = 0; job.source_paper_fixture && i < variances.size(); ++i) {
            variances(i) = std::pow(gum::source_paper_fixture_uncertainty(job.measurement.fixture(i / 3, i % 3)), 2);
        }
        job.measurement.fixture_covariance = variances.asDiagonal();
        if (stated_u.maxCoeff() > 0.0) {
            job.stated_fixture_u = stated_u;
        }
    }
    names.is_whole = true;
    return names;
}

void read_fixture_covariance(const RotaryTableReading& reading, const FixtureNames& names, const JobFiles::File& file) {
    RotaryTableJob& job = reading.job();
    // Without a fixture the order of the matrix is not known.
    if (!names.is_whole) {
        return;
    }
    const std::size_t order = 3 * names.reflectors.size();
    const std::optional<Eigen::MatrixXd> matrix = read_csv_matrix(file.bytes, order, "µm²", *file.problems);
    if (!matrix) {
        return;
    }
    const std::string& name = file.problems->file();
    const auto element = [&](Eigen::Index i, Eigen::Index j) {
        return "element (" + std::to_string(i + 1) + ", " + std::to_string(j + 1) + ")";
    };
    const std::size_t problems_before = file.problems->refusals();
    for (Eigen::Index i = 0; i < matrix->rows(); ++i) {
        if (!((*matrix)(i, i) > 0.0)) {
            file.problems->refuse(k_covariance_not_positive, where_in_row(name, i),
                                  element(i, i) + " is " + text::shortest_plain((*matrix)(i, i)) + " µm²",
                                  "a variance must be greater than 0", "correct the matrix");
        }
        for (Eigen::Index j = 0; j < i; ++j) {
            const double a = (*matrix)(i, j);
            const double b = (*matrix)(j, i);
            // A few last digits may differ in a matrix that another program computed.
            const double scale = std::sqrt(std::abs((*matrix)(i, i)) * std::abs((*matrix)(j, j)));
            if (!(std::abs(a - b) <= 1e-9 * std::max({scale, std::abs(a), std::abs(b)}))) {
                file.problems->refuse(k_covariance_not_symmetric, where_in_row(name, i),
                                      element(i, j) + " is " + text::shortest_plain(a) + " µm², " + element(j, i) +
                                          " is " + text::shortest_plain(b) + " µm²",
                                      "a covariance matrix is symmetric", "correct the matrix");
            }
        }
    }
    if (file.problems->refusals() != problems_before) {
        return;
    }
    const Eigen::MatrixXd symmetric = 0.5 * (*matrix + matrix->transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
    const double smallest = solver.eigenvalues().minCoeff();
    const double largest = solver.eigenvalues().maxCoeff();
    const double rounding = 10.0 * static_cast<double>(order) * std::numeric_limits<double>::epsilon() * largest;
    if (solver.info() != Eigen::Success || !std::isfinite(largest) || !(smallest >= -rounding)) {
        file.problems->refuse(k_covariance_not_positive, text::visible(name),
                              "the smallest eigenvalue is " + text::shortest_plain(smallest) + " µm², the largest " +
                                  text::shortest_plain(largest) + " µm²",
                              "a covariance matrix is positive semi-definite",
                              "correct the matrix, and give it with all its digits");
        return;
    }
    const Eigen::MatrixXd si = symmetric * (k_micrometre * k_micrometre);
    const Eigen::VectorXd from_columns = job.measurement.fixture_covariance.diagonal();
    // One cause, as a rule: columns of another measurement of the fixture. The coordinate that differs most is named.
    Eigen::Index differing = 0;
    Eigen::Index most = 0;
    double largest_ratio = 0.0;  // in either sense
    for (Eigen::Index i = 0; i < si.rows(); ++i) {
        const double ratio = std::sqrt(si(i, i) / from_columns(i));
        if (std::abs(ratio - 1.0) > 0.01) {
            ++differing;
            if (const double either = std::max(ratio, 1.0 / ratio); either > largest_ratio) {
                largest_ratio = either;
                most = i;
            }
        }
    }
    if (differing > 0) {
        const std::string from_matrix = text::shortest_plain(std::sqrt(symmetric(most, most))) + " µm";
        const std::string from_column = text::shortest_plain(std::sqrt(from_columns(most)) / k_micrometre) + " µm";
        file.problems->warn(k_warn_covariance_differs, where_in_row(name, most),
                            "u from the covariance is " + from_matrix + ", from the column of the fixture file " +
                                from_column +
                                (differing > 1 ? "; " + std::to_string(differing) + " of " + std::to_string(si.rows()) +
                                                     " coordinates differ, this one most"
                                               : std::string()),
                            "the covariance is used", "correct whichever is wrong");
    }
    job.measurement.fixture_covariance = si;
}

void read_fixture_budget(const RotaryTableReading& reading, const FixtureNames& names, const FileSource& source) {
    const std::optional<std::string>& name = reading.stated.fixture.budget;
    const std::optional<JobFiles::File> file = name ? reading.files.open(*name) : std::nullopt;
    if (!file) {
        return;
    }
    reading.job().fixture_budget_file = *name;
    try {
        auto budget = std::make_shared<const BudgetJob>(read_undivided_budget_job(source, file->problems->file()));
        reading.files.add(budget->files, budget->warnings);
        if (names.is_whole) {
            check_points(*budget, names, *file->problems);
        }
        reading.job().fixture_budget = budget;
        reading.job().fixture_budget_job = std::move(budget);
    } catch (const gum::InputError& error) {
        reading.files.add(error);
    } catch (const gum::StorageError& error) {
        reading.files.add(error);
    }
}

}  // namespace gumcert::jobs
