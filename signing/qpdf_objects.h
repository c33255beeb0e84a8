#pragma once

// The headers of qpdf, for the sources of this layer alone.

#define POINTERHOLDER_TRANSITION 4  // std::shared_ptr, without qpdf's own pointer of old

// JSON.hh of qpdf 11.3 does not compile with Clang and libstdc++ 12 in C++20 (a vector of a class within that class),
// and nothing of it is used here: the declaration is enough.
#ifndef JSON_HH
#define JSON_HH
class JSON;
#endif

#include <qpdf/Pipeline.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFEFStreamObjectHelper.hh>
#include <qpdf/QPDFEmbeddedFileDocumentHelper.hh>
#include <qpdf/QPDFFileSpecObjectHelper.hh>
#include <qpdf/QPDFNameTreeObjectHelper.hh>
#include <qpdf/QPDFObjectHandle.hh>
#include <qpdf/QPDFWriter.hh>
#include <qpdf/QPDFXRefEntry.hh>

#include <new>
#include <string_view>

namespace gumcert::signing {

/// qpdf goes on where an allocation failed, and says it in a warning: what it reads then is not what was written, and a
/// signature can seem to be missing.
/// \throws std::bad_alloc
inline void require_whole_memory(QPDF& document) {
    for (const QPDFExc& warning : document.getWarnings()) {
        if (std::string_view(warning.what()).find("std::bad_alloc") != std::string_view::npos) {
            throw std::bad_alloc();
        }
    }
}

}  // namespace gumcert::signing
