#pragma once

#include <string>

#include "signing/qpdf_objects.h"
#include "tests/support/written_pdf.h"

namespace gumcert::signing::test {

/// A page with a text, and a file attached unless it is empty.
inline std::string plain_pdf(const std::string& attachment = {}) {
    QPDF pdf;
    gumcert::test::begin_with_page(pdf, "0 0 100 100 re S % U = 0.12");
    if (!attachment.empty()) {
        auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, attachment);
        QPDFEmbeddedFileDocumentHelper(pdf).replaceEmbeddedFile(
            "certificate.xml", QPDFFileSpecObjectHelper::createFileSpec(pdf, "certificate.xml", stream));
    }
    return gumcert::test::written_pdf(pdf);
}

}  // namespace gumcert::signing::test
