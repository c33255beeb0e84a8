#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "certificate/laboratory_register.h"

namespace gumcert::jobs {

/// A value as people write it: 0.00006, where JSON has 6e-05.
[[nodiscard]] std::string in_words(const nlohmann::json& value);

/// Where two values part: the members and the entries that differ, each by what stands there.
/// \param where  of the stated one
/// \param found  receives them
void note_differences(const nlohmann::json& stated, const nlohmann::json& registered, const std::string& subject,
                      const std::string& where, std::vector<certificate::LaboratoryRegister::Contradiction>& found);

}  // namespace gumcert::jobs
