#pragma once

#include <string>

#include "signing/qpdf_objects.h"

namespace gumcert::signing::test {

inline std::string written(QPDF& pdf) {
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.setStaticID(true);
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

/// A page with a text, and a file attached unless it is empty.
inline std::string plain_pdf(const std::string& attachment = {}) {
    QPDF pdf;
    pdf.emptyPDF();
    auto page = QPDFObjectHandle::parse("<< /Type /Page /MediaBox [0 0 595 842] /Resources << >> >>");
    page.replaceKey("/Contents", QPDFObjectHandle::newStream(&pdf, "0 0 100 100 re S % U = 0.12"));
    pdf.addPage(pdf.makeIndirectObject(page), false);
    if (!attachment.empty()) {
        auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, attachment);
        QPDFEmbeddedFileDocumentHelper(pdf).replaceEmbeddedFile(
            "certificate.xml", QPDFFileSpecObjectHelper::createFileSpec(pdf, "certificate.xml", stream));
    }
    return written(pdf);
}

}  // namespace gumcert::signing::test
