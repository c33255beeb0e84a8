#pragma once

#include <optional>
#include <string>
#include <vector>

#include "laboratory/standard_record.h"

namespace gumcert::laboratory {

/// What a standard is used for.
struct StandardUse {
    std::string quantity = {}, range = {}, mode = {};  ///< as the register names them; "" where nothing is said
    std::optional<double> at = {};                     ///< value at which it is used, in the unit of the nominal values
    std::string date = {};                             ///< day of use; "" where it is not known
};

enum class Answer { yes, no, unknown };

struct Applicability {
    Answer answer = Answer::yes;
    std::string because;  ///< English, without a full stop; "" for yes
    /// Whether the reason is when the calibration is valid, which dates of a certificate show as well.
    bool is_of_validity = false;

    friend bool operator==(const Applicability& a, const Applicability& b) {
        return a.answer == b.answer && a.because == b.because;
    }
};

/// Lines of a certificate that a use may mean, and what speaks against it.
struct Candidates {
    const Calibration* calibration = nullptr;       ///< valid on the day; null: none
    std::vector<const CalibrationResult*> results;  ///< that quantity, range and mode leave
    bool is_narrowed =
        true;  ///< false: they are of several quantities, ranges or modes, and the use does not say which
    Applicability verdict;
};

/// By date, then quantity, range and mode, and then the value. The first "no" is the answer; else the first "unknown".
///
/// date: no day stated: unknown. No calibration up to the day: no. Day after valid_to, or where none is stated
/// after the next calibration by the plan: no; neither is known: unknown.
/// quantity: none stated, and the certificate has several: unknown; none of its lines has it: no.
/// range, mode: stated, and no line has it: no, or unknown where lines say nothing of it (these are left then); not stated,
/// and the lines have several: unknown.
[[nodiscard]] Candidates candidates_for(const StandardRecord& record, const StandardUse& use);

/// The same with the value `at`. Right are the nominal value of a line (within 1e-9 of it), a value between the limits of a
/// line, and, where the record interpolates, one between two nominal values. Between two nominal values without
/// interpolation: unknown; beyond them: no. Lines without nominal value and limits: unknown. No value stated, and more
/// than one line: unknown.
[[nodiscard]] Applicability applicability(const StandardRecord& record, const StandardUse& use);

/// Whether two values of one unit are the same point of a certificate.
[[nodiscard]] bool is_same_value(double a, double b);

/// "7.5 V": a value of use with the unit of the nominal values of lines; without where they have several.
[[nodiscard]] std::string value_in_words(double at, const std::vector<const CalibrationResult*>& lines);

}  // namespace gumcert::laboratory
