#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "self_test/case_formula.h"

namespace gumcert::self_test {

/// A value that a publication states of a case.
struct ExpectedValue {
    /// Which number of the source it is; "" where not stated.
    std::string quantity = {}, kind = {}, input = {}, unit = {};
    bool is_printed = true;  ///< by the source; else it comes from an independent calculation
    std::string text = {};   ///< its digits, as they are printed
    CaseValue wanted = {};   ///< a number where the text is one
    std::optional<double> tolerance = {}, relative_tolerance = {};
    std::string tolerance_formula = {};   ///< in place of a number; "": none
    std::vector<std::string> found = {};  ///< paths or formulas; empty where it is not compared
    std::string not_compared = {};        ///< why; "": it is compared
    std::string note = {};

    /// "l contribution [ls]".
    [[nodiscard]] std::string name() const;
    /// Significant digits of the text; 0 where it is no number, or an infinite one.
    [[nodiscard]] int digits() const;
    /// Half a unit of the last printed digit: "1.60E-3" has 0.000005, in the unit of the value.
    [[nodiscard]] double half_unit() const;
};

/// A published case as data (tests/reference/cases/README.md).
struct ReferenceCase {
    std::string id = {};                    ///< name of its file without ending
    std::string title = {}, topic = {};     ///< English
    std::string document = {}, place = {};  ///< with edition; clause, table or example, "" where none is stated
    bool is_place_seen = true;              ///< false: nobody looked the place up
    std::string seen = {};                  ///< "opened", "quoted" or "recalled"
    std::string checked_by = {}, note = {};
    nlohmann::ordered_json jobs = {};  ///< by name, in the order of the case: that of results is that of the record
    nlohmann::json data = {};          ///< by name
    std::vector<ExpectedValue> expected = {};
};

/// \throws gum::InputError  GC-SELF-0002 if the text is not a case
[[nodiscard]] ReferenceCase reference_case_from_json(const std::string& text, const std::string& id);

/// How many digits of an expected number another one reaches: the largest m for which both differ by at most half a unit of
/// the m-th significant digit. 0 where not even the first one agrees.
/// \param digits  of the expected number; the result is not larger
[[nodiscard]] int digits_reached(double expected, int digits, double found);

}  // namespace gumcert::self_test
