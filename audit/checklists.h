#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"

#include "audit/word_line.h"

namespace gumcert::audit {

/// A contribution that a budget of a method has to name, with a number or with the reason why it is left out.
struct RequiredContributor {
    Sentence name;                        ///< for people: "thermal expansion of the gauge block"
    std::vector<Contributor> by;          ///< a row of one of these is it
    std::vector<std::string_view> words;  ///< or a row with one of these words (audit/word_line.h)
    /// Or any row with U and k of a certificate: what it is called says nothing, as of a dew point or a wavelength.
    bool by_certificate = false;
};

struct MethodChecklist {
    std::string_view method;  ///< id, AuditedBudget::method
    Sentence title;           ///< for people
    /// Documents that the list follows, with their titles; which clause of them asks for what was not verified.
    std::string_view source;
    std::vector<std::string_view> words;        ///< by which the name of a budget tells its method
    std::vector<RequiredContributor> required;  ///< beside the six of every method
    /// Words of other instruments whose names have one of `words` in them: a thermocouple is no Pt100 thermometer.
    std::vector<std::string_view> not_with = {};
};

/// The checklists of all methods that have one.
[[nodiscard]] std::span<const MethodChecklist> method_checklists();
/// What the budgets of every method name at least: repeatability, resolution, reproducibility, uncertainty and stability
/// of the reference standard, environment. (A2LA R205, clause to be verified)
[[nodiscard]] std::span<const RequiredContributor> minimum_contributors();

/// The checklist of a method; nullptr where there is none.
[[nodiscard]] const MethodChecklist* checklist_of(std::string_view method);
/// A method in words: the title of its checklist, else what the budget says itself.
[[nodiscard]] std::string method_in_words(std::string_view method);
/// Id of the method that a title names, in English or German: "Calibration of micrometers"; "" where it names none.
[[nodiscard]] std::string method_in_title(std::string_view title);

/// Whether a title names a material measure, in English or German: a weight, a gauge, a resistor. It shows nothing, so that it
/// has no resolution (VIM 3.6). False where it names an instrument as well, or one of the checklists of instruments.
[[nodiscard]] bool names_material_measure(std::string_view title);

/// Whether a row holds the scatter of readings, or a pooled one: that is repeatability, whatever it is called. Not where
/// its words say that a condition was read.
[[nodiscard]] bool is_scatter_of_readings(const AuditedRow& row);

/// What a row is called, to hold it against one required contributor after the other.
class NamedRow {
public:
    explicit NamedRow(const AuditedRow& row);
    /// Whether the row stands for a required contributor, whatever number it has.
    [[nodiscard]] bool stands_for(const RequiredContributor& required) const;

private:
    /// That of the row, and those of the parts of a name like "Reproducibility (clamping, datum)".
    std::vector<Contributor> contributors_;
    bool is_scatter_, is_certified_;
    std::array<WordLine, 4> words_;
};
[[nodiscard]] bool stands_for(const AuditedRow& row, const RequiredContributor& required);

}  // namespace gumcert::audit
