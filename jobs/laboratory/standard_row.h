#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "certificate/laboratory_register.h"
#include "laboratory/standard_record.h"

namespace gumcert::jobs {

/// What a certificate lists of a standard of the register, as an entry of `standards` of certificate data.
/// \param day    of the work, "" where it is not stated
/// \param lines  of its certificates that were used, each once; none: the first of them
[[nodiscard]] nlohmann::json standard_row(const laboratory::StandardRecord& record, const std::string& day,
                                          const std::vector<const laboratory::CalibrationResult*>& lines);

/// Where an entry of `standards` that somebody wrote says something else than the register.
/// \param row      standard_row()
/// \param pointer  of the entry
/// \param found    receives it
void note_contradictions(const nlohmann::json& stated, const nlohmann::json& row,
                         const laboratory::StandardRecord& record, const std::string& pointer,
                         std::vector<certificate::LaboratoryRegister::Contradiction>& found);

}  // namespace gumcert::jobs
