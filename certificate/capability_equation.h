#pragma once

#include <string>

#include "certificate/capability.h"
#include "gum/expression/equation_system.h"

namespace gumcert::certificate {

/// The expression of a capability as an equation of plain numbers, one output.
/// \param expanded  from expanded_capability_expression()
/// \throws gum::InputError  as EquationSystem::compile
[[nodiscard]] gum::EquationSystem compile_capability(const Capability& capability, const std::string& expanded);

}  // namespace gumcert::certificate
