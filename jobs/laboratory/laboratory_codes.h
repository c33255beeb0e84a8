#pragma once

#include <array>

#include "jobs/input_codes.h"

namespace gumcert::jobs {

// What is refused in the files of a laboratory and in what jobs take from them. Dates, units, texts and lists have the codes
// of certificate data (jobs/certificate/certificate_codes.h); what the register itself cannot answer, those of laboratory/.
inline constexpr InputCode k_laboratory_missing{"GC-LAB-0100", "a job refers to the laboratory and names none"};
inline constexpr InputCode k_laboratory_id{"GC-LAB-0101", "an identification that is not the name of its file"};
inline constexpr InputCode k_laboratory_order{"GC-LAB-0102", "calibrations that are not in the order of their dates"};
inline constexpr InputCode k_laboratory_coverage{"GC-LAB-0103", "an expanded uncertainty that is not stated as one"};
inline constexpr InputCode k_laboratory_drift{"GC-LAB-0104", "a drift model that lacks what it needs"};
inline constexpr InputCode k_laboratory_interval{"GC-LAB-0105", "a plan of recalibration that lacks what it needs"};
inline constexpr InputCode k_laboratory_person{"GC-LAB-0106", "a person whom the laboratory does not name"};
inline constexpr InputCode k_laboratory_day{"GC-LAB-0107", "the day on which a standard was used is not known"};
inline constexpr InputCode k_laboratory_unit{"GC-LAB-0108", "a standard of another quantity than its input"};
inline constexpr InputCode k_laboratory_shared{"GC-LAB-0109", "several inputs draw on one standard"};
inline constexpr InputCode k_laboratory_schema{"GC-LAB-0110", "a file of the laboratory of another form"};
inline constexpr InputCode k_laboratory_other_day{"GC-LAB-0111",
                                                  "a standard that is used outside of the days of the work"};
inline constexpr InputCode k_laboratory_absent{"GC-LAB-0112",
                                               "a standard, customer or method that the laboratory does not have"};

inline constexpr std::array k_laboratory_codes{
    k_laboratory_missing,  k_laboratory_id,        k_laboratory_order, k_laboratory_coverage, k_laboratory_drift,
    k_laboratory_interval, k_laboratory_person,    k_laboratory_day,   k_laboratory_unit,     k_laboratory_shared,
    k_laboratory_schema,   k_laboratory_other_day, k_laboratory_absent};

}  // namespace gumcert::jobs
