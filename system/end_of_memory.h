#pragma once

namespace gumcert::system {

/// What this process says and writes follows from its inputs, and never from memory that could not be had. Libraries go on
/// without it: libxml2 2.9 calls a document not well-formed, qpdf finds no root of a PDF, a stream leaves a text half, and
/// OpenSSL 3.0 ends in a segmentation fault. From now on:
///
/// - an allocation of C++ that fails is remembered, memory_has_ended();
/// - libxml2 and OpenSSL take their memory from functions with a reserve, which they get when memory ends: they end what
///   they began as ever. Where that is used up, too, the process ends by std::terminate(), with std::bad_alloc as the exception.
///
/// Before anything else is asked of the two libraries; once, for the whole process.
void prepare_for_end_of_memory();

/// Whether an allocation failed since prepare_for_end_of_memory().
[[nodiscard]] bool memory_has_ended();

/// Before something is said or put in place.
/// \throws std::bad_alloc  where memory_has_ended()
void require_memory();

}  // namespace gumcert::system
