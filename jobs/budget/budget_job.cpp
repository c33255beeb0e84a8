#include "jobs/budget/budget_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "certificate/point_limits.h"
#include "gum/expression/name.h"
#include "jobs/budget/budget_correlation.h"
#include "jobs/budget/budget_fit_statement.h"
#include "jobs/budget/budget_inputs.h"
#include "jobs/budget/budget_job_statement.h"
#include "jobs/budget/budget_points.h"
#include "jobs/budget/budget_results.h"
#include "jobs/budget/budget_statement.h"
#include "jobs/budget/budget_tables.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/certificate/certificate_statement.h"
#include "jobs/job_files.h"
#include "jobs/job_kind.h"
#include "jobs/job_reader.h"
#include "jobs/json_object.h"
#include "jobs/laboratory/laboratory_certificate.h"
#include "jobs/laboratory/laboratory_use.h"
#include "text/counts.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

/// Reads one job; every step notes what it finds, and `result` throws or returns at the end.
class Reader {
public:
    Reader(const FileSource& source, const std::string& job_file) : files_(source, job_file) {}

    BudgetJob result() {
        const JobFiles::File file = files_.job();
        problems_ = file.problems;
        document_ = read_json_document(file.bytes, *problems_);
        if (document_) {
            read_job();
        }
        files_.refuse_if_needed();
        job_.document = std::move(document_->value);
        job_.files = files_.names();
        job_.warnings = files_.warnings();
        return std::move(job_);
    }

private:
    void read_job() {
        if (!is_budget()) {
            return;
        }
        LaboratoryUse laboratory(files_, *document_, *problems_);
        laboratory.fill_inputs(*document_);
        const std::optional<JsonObject> root = JsonObject::root(*document_, keys_of<BudgetStatement>(), *problems_);
        if (!root) {
            return;
        }
        read_common(*root);
        const std::vector<JsonObject> parts = read_sections(*root);
        if (!job_.sections.empty()) {
            read_shared_equations(*root);
        }
        for (std::size_t i = 0; i < parts.size(); ++i) {
            read_equations(parts[i], i);
        }
        refuse_unused_equations();
        const std::optional<StatedCovariance> covariance = read_covariance(*root, *document_, files_, *problems_);
        BudgetInputs inputs(*document_, covariance, files_, *problems_);
        inputs.read(*root);
        std::map<std::string, std::size_t> positions;
        job_.inputs = inputs.inputs(positions);
        const std::size_t problems_before = problems_->refusals();
        job_.fits = read_fits(*root, *document_, inputs.names(), files_, *problems_);
        model_is_whole_ = model_is_whole_ && problems_->refusals() == problems_before;
        read_correlations(*root, *document_, covariance, positions, inputs.names(), job_, *problems_);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::size_t before = job_.outputs.size();
            read_outputs(parts[i]);
            if (!job_.sections.empty()) {
                job_.sections[i].outputs = job_.outputs.size() - before;
            }
        }
        BudgetPoints points(*document_, inputs, files_, laboratory, job_, *problems_);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::size_t before = job_.points.size();
            points.read(parts[i], used_by(i));
            if (!job_.sections.empty()) {
                job_.sections[i].points = job_.points.size() - before;
            }
        }
        if (root->has("points") || root->has("sections")) {
            points.finish();
        }
        job_.standard_components = laboratory.components();
        job_.own_components = inputs.own_components();
        job_.input_descriptions = inputs.descriptions();
        job_.input_parts = inputs.parts();
        double p = job_.coverage_probability;
        for (const gum::BudgetOutput& output : job_.outputs) {
            p = std::max(p, output.coverage_probability.value_or(p));
        }
        job_.monte_carlo = read_monte_carlo(*root, p, 2, *problems_);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            check_model(parts[i], i, inputs);
        }
        check_sections(inputs, points);
        LaboratoryCertificate completion(laboratory);
        job_.certificate = read_certificate(files_, *document_, *problems_, &completion);
        job_.registered = job_.certificate ? laboratory.registered() : std::nullopt;
        read_tables(parts, *document_, inputs, points, job_, *problems_);
        warn_of_unused();
    }

    bool is_budget() {
        if (document_->value.is_discarded()) {
            return false;
        }
        if (!document_->value.is_object()) {
            problems_->refuse(k_wrong_type, document_->where(""), "the document is " + described(document_->value),
                              "must be an object", "write { \"key\": value, … }");
            return false;
        }
        const auto text_of = [&](const char* key, const std::string& expected) -> std::optional<std::string> {
            const auto found = document_->value.find(key);
            if (found == document_->value.end()) {
                problems_->refuse(k_missing_key, document_->where(""),
                                  "the key " + text::in_quotes(key) + " is missing", "the key is required",
                                  "add " + text::in_quotes(key) + ": " + text::in_quotes(expected));
            } else if (!found->is_string() && !found->is_discarded()) {
                problems_->refuse(k_wrong_type, document_->where(child_pointer("", key)), described(*found),
                                  "must be a string", "write " + text::in_quotes(expected));
            } else if (found->is_string()) {
                return found->get<std::string>();
            }
            return std::nullopt;
        };
        const auto schema = text_of("schema", "gumcert/job/1");
        if (schema && *schema != "gumcert/job/1") {
            problems_->refuse(k_wrong_schema, document_->where("/schema"), text::in_quotes(*schema),
                              "must be \"gumcert/job/1\"",
                              "check that the file is a job, and which version of the program it is for");
        }
        const auto kind = text_of("kind", std::string(k_budget_kind));
        if (kind && *kind != k_budget_kind) {
            problems_->refuse(k_wrong_kind, document_->where("/kind"), "a job of kind " + text::in_quotes(*kind),
                              "a job of kind \"budget\" is expected here", "use the command for this kind of job");
        }
        return kind && *kind == k_budget_kind;
    }

    void read_common(const JsonObject& root) {
        JobReader reader(root);
        read_title(root, {&*document_, root.pointer("title"), problems_}, job_.title);
        reader.read(stated_, {"coverage_probability"});
        reader.read(stated_, {"coverage"});
        read_unused_texts(root);
        reader.read(stated_, {"reporting"});
    }

    /// The objects that hold equations, results and points: the sections, or the job itself.
    std::vector<JsonObject> read_sections(const JsonObject& root) {
        const json* sections = root.find("sections");
        if (sections == nullptr) {
            return {root};
        }
        for (const char* key : {"solve_for", "outputs", "points", "tables"}) {
            if (root.has(key)) {
                root.refuse(k_two_statements, key, text::in_quotes(key) + " is given beside \"sections\"",
                            "a job with sections has equations, results and points in them",
                            "move it into the section that it belongs to");
            }
        }
        std::vector<JsonObject> parts;
        if (!sections->is_object() || sections->empty() || sections->size() > k_most_sections) {
            root.refuse(sections->is_object() ? k_wrong_size : k_wrong_type, "sections",
                        sections->is_object() ? text::count_of(sections->size(), "section") : described(*sections),
                        "must be an object of 1 to " + std::to_string(k_most_sections) + " sections",
                        "write {\"DC voltage\": {\"model\": [\"name = expression\"]}}");
            model_is_whole_ = false;
            return parts;
        }
        for (const std::string& name : keys_in_order(*document_, root.pointer("sections"))) {
            const std::string pointer = child_pointer(root.pointer("sections"), name);
            if (const auto objection = name_objection(name)) {
                problems_->refuse(k_text_not_allowed, document_->where(pointer),
                                  "the name of the section " + *objection,
                                  "a name has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                                  "correct the name");
                continue;
            }
            if (!sections->at(name).is_object()) {
                problems_->refuse(k_wrong_type, document_->where(pointer), described(sections->at(name)),
                                  "must be an object", "state its model, outputs and points");
                model_is_whole_ = false;
                continue;
            }
            if (const auto kind = sections->at(name).find("kind"); kind != sections->at(name).end()) {
                problems_->refuse(
                    k_sections_of_other_kind, document_->where(child_pointer(pointer, "kind")),
                    "a section of kind " + described(*kind),
                    "sections are parts of a budget, with equations, results and points",
                    "remove \"kind\" from a part of this budget; a job of another kind has a certificate of "
                    "its own, or its results come in by \"gumcert import dcc\"");
                model_is_whole_ = false;
                continue;
            }
            parts.emplace_back(*document_, pointer, keys_of<SectionStatement>(), *problems_);
            job_.sections.push_back({.name = name});
            certificate::LocalisedText& title = job_.section_titles.emplace_back();
            if (const json* stated = parts.back().find("title"); stated != nullptr && stated->is_object()) {
                read_localised(*stated, title, true, {&*document_, parts.back().pointer("title"), problems_});
            } else {
                title = parts.back().optional_string("title").value_or("");
            }
        }
        return parts;
    }

    void read_equations(const JsonObject& part, std::size_t section) {
        const std::size_t equations = job_.model.size();
        const std::size_t unknowns = job_.unknowns.size();
        std::vector<gum::EquationText> own = equations_of(part);
        for (const std::size_t shared : shared_by(part, own)) {
            job_.model.push_back(shared_[shared].text);
            shared_[shared].is_used = true;
        }
        std::move(own.begin(), own.end(), std::back_inserter(job_.model));
        read_unknowns(part);
        if (!job_.sections.empty()) {
            job_.sections[section].equations = job_.model.size() - equations;
            job_.sections[section].unknowns = job_.unknowns.size() - unknowns;
        }
    }

    /// Equations beside the sections: each section has those that its results rest on, as if they stood in it.
    void read_shared_equations(const JsonObject& root) {
        for (gum::EquationText& text : equations_of(root)) {
            try {
                gum::EquationNames names = gum::equation_names(text);
                if (names.defines.empty()) {
                    problems_->refuse(k_shared_equation, text.where, "an implicit equation beside the sections",
                                      "an unknown is solved for in the section whose result it is",
                                      "move it into the section, with its \"solve_for\"");
                    continue;
                }
                shared_.push_back({std::move(text), std::move(names)});
            } catch (const gum::DiagnosedError& error) {
                refuse_as(error, "", *problems_);
                model_is_whole_ = false;
            }
        }
    }

    /// Which of the shared equations a section has, in their order: what its own equations and its results name, and
    /// what these name in turn.
    [[nodiscard]] std::vector<std::size_t> shared_by(const JsonObject& part,
                                                     const std::vector<gum::EquationText>& own) {
        std::vector<std::string> wanted;
        if (const json* outputs = part.find("outputs"); outputs != nullptr && outputs->is_object()) {
            for (const auto& [name, output] : outputs->items()) {
                wanted.push_back(gum::canonical_name(name));
            }
        }
        for (const gum::EquationText& equation : own) {
            try {
                const gum::EquationNames names = gum::equation_names(equation);
                wanted.insert(wanted.end(), names.uses.begin(), names.uses.end());
                refuse_defined_twice(equation, names.defines);
            } catch (const gum::DiagnosedError&) {
                continue;  // refused with the model
            }
        }
        std::set<std::size_t> found;
        while (!wanted.empty()) {
            const std::string name = std::move(wanted.back());
            wanted.pop_back();
            for (std::size_t i = 0; i < shared_.size(); ++i) {
                if (shared_[i].names.defines == name && found.insert(i).second) {
                    wanted.insert(wanted.end(), shared_[i].names.uses.begin(), shared_[i].names.uses.end());
                }
            }
        }
        return {found.begin(), found.end()};
    }

    void refuse_defined_twice(const gum::EquationText& equation, const std::string& name) {
        const auto shared = std::find_if(shared_.begin(), shared_.end(), [&](const SharedEquation& s) {
            return !name.empty() && s.names.defines == name;
        });
        if (shared != shared_.end()) {
            problems_->refuse(k_name_of_two, equation.where,
                              text::in_quotes(name) + " is defined here, and for all sections at " + shared->text.where,
                              "a name stands for one quantity", "rename one of the two");
            shared->is_used = true;  // nothing more is said of it
            model_is_whole_ = false;
        }
    }

    void refuse_unused_equations() {
        for (const SharedEquation& shared : shared_) {
            if (!shared.is_used) {
                problems_->refuse(k_shared_equation, shared.text.where,
                                  "no section uses " + text::in_quotes(shared.names.defines),
                                  "equations beside the sections are those that sections share",
                                  "remove it, or move it into the section whose result it is");
            }
        }
    }

    /// Names that the results of a section rest on; nothing for a whole job, whose points state what they like.
    [[nodiscard]] std::optional<std::set<std::string>> used_by(std::size_t section) const {
        if (job_.sections.empty()) {
            return std::nullopt;
        }
        std::set<std::string> names;
        const gum::Budget part = gum::budget_of_section(job_, section);
        for (const gum::EquationText& equation : part.model) {
            try {
                for (const std::string& name : gum::equation_names(equation).uses) {
                    names.insert(name);
                }
            } catch (const gum::DiagnosedError&) {
                return std::nullopt;  // refused with the model
            }
        }
        if (part.model.empty()) {
            for (const gum::BudgetOutput& output : part.outputs) {
                names.insert(gum::canonical_name(output.name));
            }
        }
        return names;
    }

    /// A result has one name in the whole job, and an input is used in one section at least.
    void check_sections(const BudgetInputs& inputs, const BudgetPoints& points) {
        if (job_.sections.empty() || problems_->refusals() > 0 || !inputs.symbols_are_whole()) {
            return;
        }
        std::map<std::string, std::string> seen;
        for (std::size_t s = 0; s < job_.sections.size(); ++s) {
            const std::string& section = job_.sections[s].name;
            const std::string where = document_->where(child_pointer("/sections", section));
            for (const auto& [name, unit] : budget_results(gum::budget_of_section(job_, s))) {
                const auto [entry, is_new] = seen.emplace(name, section);
                if (!is_new) {
                    problems_->refuse(k_name_of_two, where,
                                      text::in_quotes(name) + " is a result of the section " +
                                          text::in_quotes(entry->second) + " too",
                                      "scope, specifications and tables know a result by its name",
                                      "give the results of different sections different names");
                }
            }
        }
        for (std::size_t i = 0; i < job_.inputs.size(); ++i) {
            bool is_used = false;
            for (std::size_t s = 0; s < job_.sections.size(); ++s) {
                is_used = is_used || points.is_used(job_.inputs[i].name, s);
            }
            if (!is_used) {
                unused_.push_back(i);
            }
        }
    }

    /// Whether an input is there for the reader: a column of a table, or what a limit or a capability depends on.
    [[nodiscard]] bool is_named(const std::string& input) const {
        for (const certificate::TableRequest& table : job_.tables) {
            if (std::any_of(table.columns.begin(), table.columns.end(),
                            [&](const auto& column) { return column.show == "column" && column.of == input; })) {
                return true;
            }
        }
        if (!job_.certificate) {
            return false;
        }
        for (const certificate::AgreedSpecification& s : job_.certificate->specifications) {
            const std::vector<std::string> names =
                s.limits ? certificate::columns_of_limits(*s.limits) : std::vector<std::string>();
            if (std::find(names.begin(), names.end(), input) != names.end()) {
                return true;
            }
        }
        const auto depends = [&](const std::vector<certificate::ScopeEntry>& scope) {
            return std::any_of(scope.begin(), scope.end(), [&](const certificate::ScopeEntry& entry) {
                return std::any_of(
                    entry.capability.arguments.begin(), entry.capability.arguments.end(),
                    [&](const certificate::CapabilityArgument& argument) { return argument.of == input; });
            });
        };
        return job_.certificate->accreditation && depends(job_.certificate->accreditation->scope);
    }

    void warn_of_unused() {
        for (const std::size_t unused : unused_) {
            const gum::BudgetInput& input = job_.inputs[unused];
            if (!is_named(input.name)) {
                problems_->warn(
                    k_warn_unused_input, input.where, "no result depends on the input " + text::in_quotes(input.name),
                    "an input that is not used has no part in any uncertainty", "remove it, or complete the model");
            }
        }
    }

    /// The key "model" of the job or of a section.
    std::vector<gum::EquationText> equations_of(const JsonObject& root) {
        std::vector<gum::EquationText> equations;
        const json* model = root.find("model");
        if (model == nullptr) {
            return equations;
        }
        const auto add = [&](const json& text, const std::string& where) {
            if (auto equation = equation_text_of(text, where, *problems_)) {
                equations.push_back(std::move(*equation));
            } else {
                model_is_whole_ = false;
            }
        };
        if (model->is_string()) {
            add(*model, root.where("model"));
        } else if (!model->is_array()) {
            root.refuse(k_wrong_type, "model", described(*model), "must be an array of equations",
                        "write [\"name = expression\"]");
            model_is_whole_ = false;
        } else {
            for (std::size_t i = 0; i < model->size(); ++i) {
                add((*model)[i], document_->where(child_pointer(root.pointer("model"), i)));
            }
        }
        return equations;
    }

    /// Members of an object, in the order of the file, each an object with some keys.
    template <typename Use>
    void for_each_member(const JsonObject& root, std::string_view key, std::span<const std::string_view> keys,
                         const Use& use) {
        const json* object = root.find(key);
        if (object == nullptr) {
            return;
        }
        if (!object->is_object()) {
            root.refuse(k_wrong_type, key, described(*object), "must be an object", "name each of them");
            model_is_whole_ = false;
            return;
        }
        for (const std::string& name : keys_in_order(*document_, root.pointer(key))) {
            const std::string pointer = child_pointer(root.pointer(key), name);
            if (!object->at(name).is_object()) {
                problems_->refuse(k_wrong_type, document_->where(pointer), described(object->at(name)),
                                  "must be an object", "write " + text::in_quotes(name) + ": {\"unit\": …}");
                model_is_whole_ = false;
                continue;
            }
            use(name, JsonObject(*document_, pointer, keys, *problems_));
        }
    }

    void read_unknowns(const JsonObject& root) {
        for_each_member(root, "solve_for", keys_of<UnknownStatement>(),
                        [&](const std::string& name, const JsonObject& object) {
                            const bool is_name = is_quantity_name(name, object.where(), *problems_);
                            const auto unit = read_unit(object, "unit", *problems_);
                            UnknownStatement stated;
                            JobReader(object).read(stated);
                            model_is_whole_ = model_is_whole_ && is_name && unit;
                            if (unit) {
                                job_.unknowns.push_back({name, unit->to_si(stated.start), *unit});
                            }
                        });
    }

    void read_outputs(const JsonObject& root) {
        for_each_member(
            root, "outputs", keys_of<OutputStatement>(), [&](const std::string& name, const JsonObject& object) {
                gum::BudgetOutput output;
                output.name = name;
                output.where = object.where();
                const nlohmann::json* const stated = object.find("description");
                certificate::LocalisedText description;
                if (stated != nullptr && stated->is_object()) {
                    read_localised(*stated, description, true, {&*document_, object.pointer("description"), problems_});
                } else {
                    description = object.optional_string("description").value_or("");
                }
                if (!description.empty()) {
                    job_.output_descriptions[name] = std::move(description);
                }
                OutputStatement probability;
                JobReader(object).read(probability);
                output.coverage_probability = probability.coverage_probability;
                output.coverage = probability.coverage;
                if (!probability.role.empty() || !probability.stage.empty() || !probability.form.empty()) {
                    job_.output_parts[name] = {std::string(probability.role), std::string(probability.stage),
                                               std::string(probability.form)};
                }
                if (object.has("unit")) {
                    output.unit = read_unit(object, "unit", *problems_);
                    model_is_whole_ = model_is_whole_ && output.unit;
                }
                job_.outputs.push_back(std::move(output));
            });
    }

    // ---- the model as a whole ---------------------------------------------------------------------------------------

    void check_model(const JsonObject& root, std::size_t section, const BudgetInputs& inputs) {
        const gum::Budget own = job_.sections.empty() ? gum::Budget() : gum::budget_of_section(job_, section);
        const gum::Budget& part = job_.sections.empty() ? job_ : own;
        if (part.model.empty()) {
            if (model_is_whole_) {
                check_without_model(root, part, inputs);
            }
            return;
        }
        if (!model_is_whole_ || !inputs.symbols_are_whole()) {
            // Names and units are not known: what can be said is whether the equations are equations.
            for (const gum::EquationText& equation : part.model) {
                try {
                    (void)gum::equation_names(equation);
                } catch (const gum::DiagnosedError& error) {
                    refuse_as(error, "", *problems_);
                }
            }
            return;
        }
        const bool is_accepted = problems_->refusals() == 0;
        std::vector<gum::InputSymbol> symbols = gum::model_inputs(part);
        if (!is_accepted) {
            // The inputs that were refused for what they state have a name and a unit all the same.
            symbols = inputs.symbols();
            std::map<std::string, std::optional<double>> constants;
            for (const gum::InputSymbol& known : gum::model_inputs(part)) {
                constants.emplace(known.name, known.constant);
            }
            for (gum::InputSymbol& symbol : symbols) {
                const auto known = constants.find(symbol.name);
                symbol.constant = known == constants.end() ? std::nullopt : known->second;
            }
            for (const gum::BudgetFit& fit : job_.fits) {
                for (const gum::BudgetFit::Parameter& parameter : fit.parameters) {
                    symbols.push_back({parameter.name, parameter.unit, std::nullopt});
                }
            }
        }
        try {
            const gum::EquationSystem system =
                gum::EquationSystem::compile(part.model, symbols, part.unknowns, gum::model_outputs(part));
            for (const gum::Diagnostic& warning : system.warnings()) {
                problems_->warn(InputCode{warning.code, {}}, warning.where, warning.what, warning.rule, warning.action);
            }
            for (const std::size_t unused : system.unused_inputs()) {
                if (is_accepted && job_.sections.empty() && unused < job_.inputs.size() &&
                    !inputs.is_read_by_specification(job_.inputs[unused].name)) {
                    unused_.push_back(unused);
                }
            }
        } catch (const gum::DiagnosedError& error) {
            refuse_as(error, "", *problems_);
        }
    }

    void check_without_model(const JsonObject& root, const gum::Budget& part, const BudgetInputs& inputs) {
        if (!part.unknowns.empty()) {
            root.refuse(k_nothing_to_evaluate, "solve_for", "unknowns without equations",
                        "an unknown is solved for from equations \"0 = expression\"", "add the model");
        }
        if (inputs.names().empty() && job_.fits.empty()) {
            if (inputs.symbols_are_whole()) {
                root.refuse(k_nothing_to_evaluate, "inputs", "a job without model, inputs and fits",
                            "there must be a quantity to evaluate", "add \"model\" and \"inputs\"");
            }
            return;
        }
        if (!job_.sections.empty() && part.outputs.empty()) {
            root.refuse(k_nothing_to_evaluate, "outputs", "a section without equations and without results",
                        "a section without a model names inputs or parameters of fits as its results",
                        "add \"outputs\", or a model");
        }
        std::map<std::string, gum::Unit> known;
        for (const gum::InputSymbol& symbol : inputs.symbols()) {
            known.emplace(symbol.name, symbol.unit);
        }
        for (const gum::BudgetFit& fit : job_.fits) {
            for (const gum::BudgetFit::Parameter& parameter : fit.parameters) {
                known.emplace(parameter.name, parameter.unit);
            }
        }
        for (const gum::BudgetOutput& output : part.outputs) {
            const auto found = known.find(output.name);
            if (found == known.end()) {
                if (inputs.symbols_are_whole() && problems_->refusals() == 0) {
                    problems_->refuse(k_output_unknown, output.where,
                                      text::in_quotes(output.name) + " is no input and no parameter",
                                      "without a model the inputs and the parameters of fits are the results",
                                      "correct the name, or add the model");
                }
            } else if (output.unit &&
                       (!(output.unit->dimension() == found->second.dimension()) ||
                        output.unit->is_celsius_temperature() != found->second.is_celsius_temperature())) {
                problems_->refuse(k_unit_does_not_fit, output.where,
                                  text::in_quotes(output.name) + " is asked for in " +
                                      text::visible(output.unit->text()) + ", and is stated in " +
                                      text::visible(found->second.text()),
                                  "both must be units of one kind of quantity", "correct the unit");
            }
        }
    }

    JobFiles files_;
    ProblemList* problems_ = nullptr;
    std::optional<JsonDocument> document_;
    BudgetStatement stated_;
    BudgetJob& job_ = stated_.job;
    struct SharedEquation {
        gum::EquationText text;
        gum::EquationNames names;
        bool is_used = false;
    };
    std::vector<SharedEquation> shared_;  ///< that sections have in common
    std::vector<std::size_t> unused_;     ///< inputs on which no result depends
    bool model_is_whole_ = true;          ///< equations, unknowns and outputs could be read
};

}  // namespace

const JobFields& budget_fields() {
    return fields_of<BudgetStatement>();
}

std::span<const JobKeys> budget_job_keys() {
    static const JobKeyTable k_keys(budget_fields());
    return k_keys.objects();
}

BudgetJob read_budget_job(const FileSource& source, const std::string& job_file) {
    return Reader(source, job_file).result();
}

BudgetJob read_undivided_budget_job(const FileSource& source, const std::string& job_file) {
    BudgetJob job = read_budget_job(source, job_file);
    if (!job.sections.empty()) {
        ProblemList problems(job_file);
        problems.refuse(k_sections_of_budget, text::visible(job_file) + "#/sections",
                        text::count_of(job.sections.size(), "section"),
                        "what builds on a budget takes the results of one model",
                        "put the section that is meant into a job of its own");
        throw gum::InputError(problems.refused());
    }
    return job;
}

BudgetJob read_budget_job(const std::filesystem::path& job_file) {
    return read_budget_job(DiskFileSource::of_job(job_file), job_file.filename().string());
}

}  // namespace gumcert::jobs
