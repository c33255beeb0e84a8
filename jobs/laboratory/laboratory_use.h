#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "certificate/laboratory_register.h"
#include "jobs/certificate/certificate_statement.h"
#include "jobs/csv_table.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"
#include "jobs/laboratory/laboratory_folder.h"
#include "laboratory/standard_value.h"

namespace gumcert::jobs {

/// What a component is that a standard of the register puts into an input; its name and its source say so in English.
struct StandardComponent {
    std::string kind;  ///< "calibration", "interpolation", "drift"
    std::string standard, certificate;
    std::string since;  ///< day of the calibration
};

/// What a job takes from the folder of the laboratory, put where the job refers to it, before the job is read: the readers
/// know statements of uncertainty and certificate data only, wherever they come from.
///
/// An input, or what a point states of it, with "standard": "STD-017" gets `components`: the calibration, the
/// interpolation where there is one, and the drift up to the day of use; those that it states itself come after them.
/// Certificate data are filled in by LaboratoryCertificate.
class LaboratoryUse {
public:
    /// \param job  as it was read; must outlive this, like the files and the list
    LaboratoryUse(JobFiles& files, const JsonDocument& job, ProblemList& problems);

    /// \param job  the same document
    void fill_inputs(JsonDocument& job);

    /// Whether the job names the standard of an input once, and its points say where it is used.
    [[nodiscard]] bool is_stated_once(const std::string& input) const { return once_.contains(input); }
    /// What the rows of a table of points take from the register: columns NAME.standard and, as in an input, NAME.at,
    /// NAME.range … An empty cell says nothing. What is wrong goes to the problems of the table.
    /// \param job      after fill_inputs(), for the units of the inputs
    /// \param columns  all that the table was asked for, in its order
    void fill_rows(const JsonDocument& job, const CsvTable& table, std::span<const std::string_view> columns,
                   ProblemList& problems);
    /// What a row states of an input, {"components": …}, in a document whose messages name the cell.
    struct Row {
        const JsonDocument* document = nullptr;  ///< null: nothing, or it was refused; lives as long as this
        std::string pointer;
    };
    [[nodiscard]] Row row(std::size_t row, const std::string& input) const;
    /// "V_s.at" is {"V_s", "at"}; two empty texts where a column is none of these. The first one lives as long as the column.
    [[nodiscard]] static std::pair<std::string_view, std::string_view> reference_column(std::string_view column);
    [[nodiscard]] static std::span<const std::string_view> reference_keys();

    /// By name and source of the component.
    using StandardComponents = std::map<std::pair<std::string, std::string>, StandardComponent>;
    [[nodiscard]] const StandardComponents& components() const { return components_; }

    /// What the gates hold against the certificate; none without a folder.
    [[nodiscard]] std::optional<certificate::LaboratoryRegister> registered() const;

    // ---- for certificate data ---------------------------------------------------------------------------------------

    /// Null where the job has none.
    [[nodiscard]] LaboratoryFolder* folder() { return folder_ ? &*folder_ : nullptr; }
    /// What registered() gives.
    [[nodiscard]] certificate::LaboratoryRegister& facts() { return facts_; }
    /// Standards that the job draws on, in the order of its inputs.
    [[nodiscard]] const std::vector<std::string>& used() const { return used_; }
    /// The lines of the certificates of a standard that inputs take, each once.
    [[nodiscard]] const std::vector<const laboratory::CalibrationResult*>& lines_of(const std::string& standard) const;
    /// The last day of the work by the certificate data, else its first; "" where they state none.
    [[nodiscard]] const std::string& day_of_work();
    /// Tells once that the folder has no such file, with what it has.
    /// \param part  "standards", "customers", "methods"
    /// \return whether there is none
    bool refuse_absent(const std::string& part, const std::string& id, const CertificatePlace& place);
    /// Notes for the gates where the plan of a standard wants it calibrated before a day of its use.
    void note_day(const laboratory::StandardRecord& record, const std::string& day);

private:
    using Json = nlohmann::json;

    /// Keeps what the job states of an input whose points say where it is used, and leaves the input to them.
    void state_once(JsonDocument& job, const std::string& input);
    void fill_points(JsonDocument& job, const std::string& list);
    void fill_row(const JsonDocument& job, const CsvTable& table, std::span<const std::string_view> columns,
                  std::size_t row, const std::string& input, ProblemList& problems);
    [[nodiscard]] const laboratory::StandardRecord* standard_of(const Json& id, const CertificatePlace& place);
    void note_use(const std::string& standard);
    /// "" where it is left out; nothing where it was refused.
    [[nodiscard]] static std::optional<std::string> read_take(const JsonDocument& job, const Json& statement,
                                                              const std::string& pointer, ProblemList& problems);
    void fill_statement(JsonDocument& job, const std::string& pointer, const std::string& input,
                        const std::string& unit_of_input, ProblemList& problems);
    [[nodiscard]] std::optional<laboratory::StandardUse> read_use(const JsonDocument& job, const Json& statement,
                                                                  const std::string& pointer, ProblemList& problems);
    [[nodiscard]] std::optional<Json> components_of(const laboratory::StandardRecord& record,
                                                    const laboratory::StandardUse& use, const std::string& unit,
                                                    bool is_deviation, const CertificatePlace& place);
    void warn_of_shared_standards(const JsonDocument& job);

    JobFiles& files_;
    const JsonDocument& job_;
    ProblemList& problems_;
    std::optional<LaboratoryFolder> folder_;
    StandardComponents components_;
    std::optional<std::string> day_of_work_;
    std::string first_day_of_work_;                              ///< "": not stated; read with day_of_work_
    std::set<std::pair<std::string, std::string>> days_of_use_;  ///< of the standards
    certificate::LaboratoryRegister facts_;
    std::vector<std::string> used_;                              ///< standards, in the order of the inputs
    std::map<std::string, std::vector<std::string>> inputs_of_;  ///< of a standard
    std::map<std::string, std::vector<const laboratory::CalibrationResult*>>
        lines_of_;                                                      ///< that inputs take, each once
    std::map<std::pair<std::size_t, std::string>, JsonDocument> rows_;  ///< by row and input
    std::set<std::string> absent_;                                      ///< files that were told to be absent
    std::map<std::string, Json> once_;  ///< by input: standard, how it is used, and components, as the job states them
};

/// What the register says of a job that was read and accepted; none where the job names no laboratory.
/// \param job_file  its name in the source
/// \throws gum::StorageError  if the job cannot be read
[[nodiscard]] std::optional<certificate::LaboratoryRegister> register_of_job(const FileSource& source,
                                                                             const std::string& job_file);

}  // namespace gumcert::jobs
