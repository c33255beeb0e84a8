#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::evaluation {

/// One line of an overview: a standard, a signatory or the accreditation. Texts are "" where nothing is stated.
struct OverviewRow {
    std::string id = {}, description = {};
    std::string from = {};            ///< last calibration; first day
    std::string certificate = {};     ///< of the last calibration
    std::string to = {};              ///< last day
    std::string next = {}, why = {};  ///< next calibration by the plan of the register, and by what
    std::string state = {};           ///< "valid", "overdue", "not_yet", "unknown"
    std::string because = {};         ///< of the state; English
};

/// What runs out in a laboratory folder, as of a day.
struct LaboratoryOverview {
    std::string day;  ///< "2026-11-24"
    std::vector<OverviewRow> standards = {}, signatories = {}, accreditation = {};

    /// Whether something is overdue: a standard, a signatory or the accreditation.
    [[nodiscard]] bool is_overdue() const;
};

/// Whether a text is a day of the calendar, "2026-11-24".
[[nodiscard]] bool is_day(const std::string& text);
/// Whether a text is the day of a time by UTC, "2026-11-24T18:52:52Z", or one beside it, as calendars elsewhere have it.
[[nodiscard]] bool is_day_somewhere(const std::string& text, const std::string& time);

/// Use case of `gumcert laboratory FOLDER`. Standards by their identifications, signatories in the order of laboratory.json.
/// \param day  a date; the caller says which, as libraries read no clock
/// \throws gum::InputError    what is wrong in the files; GC-LAB-0200 where the folder has neither laboratory.json nor a
///                            standard
/// \throws gum::StorageError  if a file cannot be read
[[nodiscard]] LaboratoryOverview laboratory_overview(const std::filesystem::path& folder, const std::string& day);

/// For people, in columns.
/// \param note  on the day, such as "today by UTC"; "": none
[[nodiscard]] std::string overview_text(const LaboratoryOverview& overview, const std::string& folder,
                                        const std::string& note);
/// For programs: what is not stated is null.
[[nodiscard]] std::string overview_json(const LaboratoryOverview& overview);
/// One table of all, its first column says what a row is.
[[nodiscard]] std::string overview_csv(const LaboratoryOverview& overview);

}  // namespace gumcert::evaluation
