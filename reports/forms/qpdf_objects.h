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
#include <qpdf/QPDFObjectHandle.hh>
#include <qpdf/QPDFWriter.hh>
#include <qpdf/QPDFXRefEntry.hh>
