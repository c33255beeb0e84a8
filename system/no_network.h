#pragma once

#include <functional>

namespace gumcert::system {

/// Does some work in a thread of its own that can open no socket, and neither can a process that it starts, for ever
/// (seccomp). What is open already stays so.
/// \param work  lets no exception out
/// \return false where the kernel does not allow it, or no thread can be made: the work is done all the same
bool without_network(const std::function<void()>& work);

}  // namespace gumcert::system
