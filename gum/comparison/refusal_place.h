#pragma once

#include <functional>
#include <string>

namespace gumcert::gum {

/// Does some work on a part of a comparison; the message of a refusal gets the place of that part.
/// \throws InputError, NoResultError  those of the work, with `where` before their own place
void at_place(const std::string& where, const std::function<void()>& work);

}  // namespace gumcert::gum
