#include "jobs/circle_closure/circle_closure_job.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "jobs/budget/budget_fit_statement.h"
#include "jobs/budget/budget_statement.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/certificate/certificate_statement.h"
#include "jobs/circle_closure/circle_closure_statement.h"
#include "jobs/csv_table.h"
#include "jobs/job_files.h"
#include "jobs/job_reader.h"
#include "jobs/json_object.h"
#include "jobs/laboratory/laboratory_certificate.h"
#include "jobs/laboratory/laboratory_use.h"
#include "jobs/statement_keys.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

/// Of an effect, what belongs to the statement of its uncertainty.
constexpr std::array<std::string_view, 13> k_statement_part{
    "value",        "u",    "U",      "k",   "p", "nu", "reliability", "half_width", "resolution",
    "distribution", "type", "source", "note"};

constexpr double k_most_coefficients = 2e7;  // of the solution by the readings, 2n·N
constexpr std::size_t k_least_of_series = 3;
constexpr std::array<std::string_view, 3> k_columns{"position", "step", "reading"};
constexpr std::array<std::string_view, 1> k_more_columns{"repetition"};
enum Column : std::size_t { c_position, c_step, c_reading, c_repetition };

/// "3", "3, repetition 2"
std::string name_of(const engine::ClosureSeries& series) {
    return std::to_string(series.position) +
           (series.repetition.empty() ? "" : ", repetition " + text::in_quotes(series.repetition));
}

class Reader {
public:
    Reader(const FileSource& source, const std::string& job_file) : files_(source, job_file) {}

    CircleClosureJob result() {
        const JobFiles::File file = files_.job();
        problems_ = file.problems;
        document_ = read_json_document(file.bytes, *problems_);
        if (document_ && is_circle_closure()) {
            if (const auto root = JsonObject::root(*document_, keys_of<CircleClosureStatement>(), *problems_)) {
                read_job(*root);
            }
        }
        files_.refuse_if_needed();
        job_.document = std::move(document_->value);
        job_.files = files_.names();
        job_.warnings = files_.warnings();
        return std::move(job_);
    }

private:
    bool is_circle_closure() {
        const auto kind = read_kind(*document_, *problems_);
        if (kind && *kind != k_circle_closure_kind) {
            problems_->refuse(k_wrong_kind, document_->where("/kind"), "a job of kind " + text::in_quotes(*kind),
                              "a job of kind \"circle_closure\" is expected here",
                              "use the command for this kind of job");
        }
        return kind && *kind == k_circle_closure_kind;
    }

    void read_job(const JsonObject& root) {
        const engine::CircleClosureMeasurement& m = job_.measurement;
        JobReader reader(root);
        read_title(root, {&*document_, root.pointer("title"), problems_}, job_.title);
        read_unused_texts(root);
        reader.read(stated_, {"coverage_probability", "coverage"});
        reader.read(stated_, {"steps", "axis", "first_angle_deg", "artefact", "numbering", "sense", "drift"});
        read_unit_of(root);
        read_repeatability(root);
        read_effects(root);
        read_monte_carlo_of(root);
        reader.read(stated_, {"readings"});
        auto file = stated_.readings ? files_.open(*stated_.readings) : std::nullopt;
        if (file && m.steps > 0) {
            read_readings(std::move(*file), root);
        }
        LaboratoryUse laboratory(files_, *document_, *problems_);
        LaboratoryCertificate completion(laboratory);
        job_.certificate = read_certificate(files_, *document_, *problems_, &completion);
    }

    void read_unit_of(const JsonObject& root) {
        job_.unit = gum::Unit::parse("arcsec");
        const auto unit = root.has("unit") ? read_unit(root, "unit", *problems_) : std::nullopt;
        if (!unit) {
            return;
        }
        if (!(unit->dimension() == gum::Dimension::angle())) {
            root.refuse(k_unit_does_not_fit, "unit", text::in_quotes(unit->text()), "readings are angles",
                        "state a unit such as \"arcsec\" or \"urad\"");
            return;
        }
        job_.unit = *unit;
    }

    void read_monte_carlo_of(const JsonObject& root) {
        job_.monte_carlo = read_monte_carlo(root, job_.coverage_probability, 1, *problems_);
        if (!job_.monte_carlo && !root.has("monte_carlo") && job_.coverage == gum::CoverageChoice::monte_carlo) {
            constexpr std::uint64_t k_most_automatic_trials = 1'000'000;
            job_.monte_carlo.emplace();
            job_.monte_carlo->most_trials = k_most_automatic_trials;
            job_.monte_carlo->where = root.where("coverage");
        }
    }

    // ---- uncertainties ----------------------------------------------------------------------------------------------

    void read_repeatability(const JsonObject& root) {
        const auto object = root.optional_object("repeatability", keys_of<RepeatabilityStatement>());
        if (!object) {
            return;
        }
        engine::CircleClosureMeasurement& m = job_.measurement;
        if (const auto u = object->required_number("u", largest_angle(above_zero(job_.unit.text())))) {
            m.stated_u = job_.unit.difference_to_si(*u);
        }
        RepeatabilityStatement& stated = stated_.repeatability;
        JobReader(*object).read(stated);
        m.stated_degrees_of_freedom = stated.degrees_of_freedom.value_or(std::numeric_limits<double>::infinity());
        m.uses_stated_u = stated.replaces_residuals && m.stated_u;
        job_.repeatability_source = stated.source;
    }

    /// Angles beyond a full turn are no deviations, whatever the unit; smaller than 1e-15 rad is nothing.
    [[nodiscard]] NumberRange largest_angle(NumberRange range) const {
        range.high = std::min(range.high, job_.unit.difference_from_si(10.0));
        return range;
    }

    void read_effects(const JsonObject& root) {
        const json* effects = root.optional_array("effects");
        if (effects == nullptr) {
            return;
        }
        if (effects->size() > k_most_effects) {
            root.refuse(k_too_many_quantities, "effects", text::count_of(effects->size(), "effect"),
                        "a job has at most " + std::to_string(k_most_effects), "combine them");
            return;
        }
        std::set<std::string> names;
        for (std::size_t i = 0; i < effects->size(); ++i) {
            const std::string pointer = child_pointer(root.pointer("effects"), i);
            if (!(*effects)[i].is_object()) {
                problems_->refuse(k_wrong_type, document_->where(pointer), described((*effects)[i]),
                                  "must be an object", "write {\"name\": …, \"acts_on\": …, \"u\": …}");
                continue;
            }
            const JsonObject object(*document_, pointer, keys_of<EffectStatement>(), *problems_);
            read_effect(object, pointer);
            const std::string name = job_.measurement.effects.empty() ? "" : job_.measurement.effects.back().name;
            if (!name.empty() && job_.measurement.effects.size() > names.size() && !names.insert(name).second) {
                object.refuse(k_name_of_two, "name", text::in_quotes(name) + " is the name of two effects",
                              "every effect is a row of the budget and has a name of its own", "rename one of them");
            }
        }
    }

    void read_effect(const JsonObject& object, const std::string& pointer) {
        EffectStatement stated;
        JobReader reader(object);
        reader.read(stated);
        const bool has_pattern = reader.accepted("acts_on");
        const bool is_scale = has_pattern && stated.pattern == engine::ClosurePattern::scale;
        std::optional<gum::Unit> unit = is_scale ? gum::Unit() : job_.unit;
        if (object.has("unit")) {
            unit = read_unit(object, "unit", *problems_);
            const gum::Dimension wanted = is_scale ? gum::Dimension() : gum::Dimension::angle();
            if (unit && has_pattern && !(unit->dimension() == wanted)) {
                object.refuse(k_unit_does_not_fit, "unit", text::in_quotes(unit->text()),
                              is_scale ? "a scale is a ratio" : "the effect is an angle",
                              "correct the unit, or \"acts_on\"");
                unit.reset();
            }
        }
        if (object.has("distribution") && object.find("distribution") != nullptr &&
            !object.find("distribution")->is_string()) {
            object.refuse(k_wrong_type, "distribution", described(*object.find("distribution")), "must be a word",
                          "write \"uniform\", \"triangular\" or \"arcsine\"");
            return;
        }
        if (!reader.accepted("name") || !has_pattern || !unit) {
            return;
        }
        const StatementKeys keys(*document_, pointer, k_statement_part, *problems_);
        const StatementContext context{.unit = *unit, .is_component = true, .input = stated.name, .files = files_};
        const auto statement = evaluate_statement(keys, context);
        if (!statement) {
            return;
        }
        const gum::StatedQuantity& q = statement->quantity;
        if (q.stated_value != 0.0 && !is_scale && stated.pattern != engine::ClosurePattern::turn) {
            object.refuse(k_closure_value, "value", "the value is " + text::shortest_plain(q.stated_value),
                          "an effect of this kind has the value 0: what is the same at all readings goes into the "
                          "zero of the series",
                          "remove \"value\"");
            return;
        }
        constexpr double k_largest_scale = 0.5;
        if (is_scale && !(std::abs(q.value) < k_largest_scale && q.u < k_largest_scale)) {
            object.refuse(k_number_out_of_range, "value",
                          "a scale of " + text::shortest_plain(q.value) + " ± " + text::shortest_plain(q.u),
                          "a correction of the scale is small beside 1", "state the correction, not the factor");
            return;
        }
        job_.measurement.effects.push_back({.name = stated.name,
                                            .source = q.source,
                                            .pattern = stated.pattern,
                                            .evaluation = q.evaluation,
                                            .value = q.value,
                                            .u = q.u,
                                            .degrees_of_freedom = q.degrees_of_freedom,
                                            .distribution = q.distribution});
    }

    // ---- readings ---------------------------------------------------------------------------------------------------

    void read_readings(JobFiles::File file, const JsonObject& root) {
        ProblemList& problems = *file.problems;
        const auto table = read_csv_table(std::move(file.bytes), k_columns, k_more_columns, problems);
        if (!table) {
            return;
        }
        engine::CircleClosureMeasurement& m = job_.measurement;
        const double last = static_cast<double>(m.steps) - 1.0;
        NumberRange reading = largest_angle({.unit = job_.unit.text()});
        reading.low = -reading.high;
        reading.hint = "check the unit of the readings";
        std::map<std::pair<std::size_t, std::string>, std::size_t> series;
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> seen;
        bool is_whole = table->is_complete();
        for (std::size_t row = 0; row < table->rows(); ++row) {
            const auto position = table->integer(row, c_position, {.low = 0.0, .high = last});
            const auto step = table->integer(row, c_step, {.low = 0.0, .high = last + 1.0});
            const auto value = table->number(row, c_reading, reading);
            const bool has_repetition = table->has_column(c_repetition) && !table->cell(row, c_repetition).text.empty();
            const auto repetition =
                has_repetition ? table->name(row, c_repetition) : std::optional<std::string_view>("");
            if (!position || !step || !value || !repetition) {
                is_whole = false;
                continue;
            }
            const std::pair key{static_cast<std::size_t>(*position), std::string(*repetition)};
            const auto [entry, is_new] = series.try_emplace(key, m.series.size());
            if (is_new) {
                m.series.push_back({.position = key.first, .repetition = key.second});
            }
            const auto [first, once] = seen.try_emplace({entry->second, static_cast<std::size_t>(*step)}, row);
            if (!once) {
                is_whole = false;
                problems.refuse(k_closure_repeated_reading, table->where(table->cell(row, c_step)),
                                "step " + std::to_string(*step) + " of position " + name_of(m.series[entry->second]) +
                                    " occurs twice, before at " + table->where(table->cell(first->second, c_step)),
                                "a series has one reading at a step",
                                "tell the readings apart in the column \"repetition\"");
                continue;
            }
            m.readings.push_back(
                {.series = entry->second, .step = static_cast<std::size_t>(*step), .value = job_.unit.to_si(*value)});
            job_.readings_as_stated.emplace_back(table->cell(row, c_reading).text);
        }
        if (is_whole && problems.refusals() == 0) {
            check_design(problems, root);
        }
    }

    void check_design(ProblemList& problems, const JsonObject& root) {
        const engine::CircleClosureMeasurement& m = job_.measurement;
        const std::string where = text::visible(problems.file());
        const auto n = static_cast<double>(m.steps);
        if (2.0 * n * static_cast<double>(m.readings.size()) > k_most_coefficients) {
            problems.refuse(k_closure_too_large, where,
                            text::count_of(m.readings.size(), "reading") + " at " + text::count_of(m.steps, "step"),
                            "twice the steps times the readings is at most 20 million",
                            "take the means of repeated series, or fewer positions");
            return;
        }
        check_ties(problems, where);
        if (const std::size_t divisor = engine::common_divisor(m); divisor > 1) {
            problems.refuse(
                k_closure_positions, where,
                divisor == m.steps ? "all readings are in one position of the artefact"
                                   : "the differences of all positions are multiples of " + std::to_string(divisor) +
                                         ", a divisor of the " + text::count_of(m.steps, "step"),
                "deviations that repeat " + text::count_of(divisor, "time") +
                    " a turn would be the same in all positions, in table and artefact alike",
                "add a position such that the differences and the number of steps have no common divisor, for example "
                "the next side");
        }
        if (m.removes_drift) {
            check_closing(root);
        }
    }

    void check_ties(ProblemList& problems, const std::string& where) {
        const engine::CircleClosureMeasurement& m = job_.measurement;
        std::vector<std::size_t> of_step(m.steps), of_side(m.steps), of_series(m.series.size());
        for (const engine::ClosureReading& reading : m.readings) {
            ++of_step[reading.step % m.steps];
            ++of_side[m.side_at(m.series[reading.series].position, reading.step)];
            ++of_series[reading.series];
        }
        const auto refuse = [&](const std::string& what, const std::string& rule) {
            problems.refuse(k_closure_not_read, where, what, rule, "measure what is missing");
        };
        for (std::size_t i = 0; i < m.steps; ++i) {
            for (const auto& [count, name] : {std::pair(of_step[i], "step "), std::pair(of_side[i], "side ")}) {
                if (count < 2) {
                    refuse(name + std::to_string(i) + " has " + (count == 0 ? "no reading" : "one reading"),
                           "closure needs every step of the table and every side of the artefact, twice at least");
                }
            }
        }
        for (std::size_t s = 0; s < m.series.size(); ++s) {
            if (of_series[s] < k_least_of_series) {
                refuse("position " + name_of(m.series[s]) + " has " + std::to_string(of_series[s]) +
                           (of_series[s] == 1 ? " reading" : " readings"),
                       "a series has 3 readings at least");
            }
        }
    }

    void check_closing(const JsonObject& root) {
        const engine::CircleClosureMeasurement& m = job_.measurement;
        const bool closes = std::any_of(m.readings.begin(), m.readings.end(),
                                        [&](const engine::ClosureReading& reading) { return reading.step == m.steps; });
        if (!closes) {
            root.refuse(k_closure_drift, "drift", "\"linear\", and no reading at step " + std::to_string(m.steps),
                        "a drift in common looks like deviations of the table unless step 0 is read again after the "
                        "full turn",
                        "add the closing readings, step " + std::to_string(m.steps) + ", or write \"drift\": \"none\"");
        }
    }

    JobFiles files_;
    ProblemList* problems_ = nullptr;
    std::optional<JsonDocument> document_;
    CircleClosureStatement stated_;
    CircleClosureJob& job_ = stated_.job;
};

/// A part of a turn in degrees, to a millionth.
double part_of_turn(std::size_t part, std::size_t steps, double first) {
    constexpr double k_shown = 1e6;
    return std::round((first + 360.0 * static_cast<double>(part) / static_cast<double>(steps)) * k_shown) / k_shown;
}

}  // namespace

double CircleClosureJob::step_angle_deg(std::size_t step) const {
    return part_of_turn(step, measurement.steps, first_angle_deg);
}

double CircleClosureJob::side_angle_deg(std::size_t side) const {
    return part_of_turn(side, measurement.steps, 0.0);
}

const JobFields& circle_closure_fields() {
    return fields_of<CircleClosureStatement>();
}

std::span<const JobKeys> circle_closure_job_keys() {
    static const JobKeyTable k_table(circle_closure_fields());
    return k_table.objects();
}

CircleClosureJob read_circle_closure_job(const FileSource& source, const std::string& job_file) {
    return Reader(source, job_file).result();
}

CircleClosureJob read_circle_closure_job(const std::filesystem::path& job_file) {
    return read_circle_closure_job(DiskFileSource::of_job(job_file), job_file.filename().string());
}

}  // namespace gumcert::jobs
