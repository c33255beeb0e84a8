
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "signing/checked_signature.h"
#include "signing/cms.h"
#include "signing/qpdf_objects.h"
#include "signing/signer.h"
#include "signing/time_texts.h"

namespace gumcert::signing {

namespace {

using Object = QPDFObjectHandle;

[[noreturn]] void refuse_pdf(const char* code, std::string what, const char* rule, const char* action) {
    throw gum::InputError(
        gum::Diagnostic{.code = code, .where = "PDF", .what = std::move(what), .rule = rule, .action = action});
}

/// Room for the CMS: the certificates, the signature and its attributes.
std::size_t room_for(const Signer& signer) {
    std::size_t bytes = 4096;
    for (const Bytes& certificate : signer.certificates()) {
        bytes += certificate.size();
    }
    return bytes;
}

// Stands for a position until the file is written; no file is so long.
constexpr long long k_position_to_come = 9'999'999'999;

Object signature_dictionary(QPDF& pdf, std::size_t room, std::int64_t signing_time) {
    Object range = Object::newArray();
    range.appendItem(Object::newInteger(0));
    for (int i = 0; i < 3; ++i) {
        range.appendItem(Object::newInteger(k_position_to_come));
    }
    Object signature = Object::newDictionary();
    signature.replaceKey("/Type", Object::newName("/Sig"));
    signature.replaceKey("/Filter", Object::newName("/Adobe.PPKLite"));
    signature.replaceKey("/SubFilter", Object::newName("/ETSI.CAdES.detached"));
    signature.replaceKey("/M", Object::newString(pdf_time_text(signing_time)));
    signature.replaceKey("/ByteRange", range);
    signature.replaceKey("/Contents", Object::newString(std::string(room, '\0')));
    return pdf.makeIndirectObject(signature);
}

/// One field without an appearance on the first page: a widget of no size, printable and locked, as PDF/A allows.
void add_field(QPDF& pdf, Object signature) {
    Object page = pdf.getAllPages().at(0);
    Object field = Object::parse("<< /Type /Annot /Subtype /Widget /FT /Sig /T (Signature1) /F 132 /Rect [0 0 0 0] >>");
    field.replaceKey("/V", signature);
    field.replaceKey("/P", page);
    field = pdf.makeIndirectObject(field);
    Object annotations = page.getKey("/Annots");
    if (!annotations.isArray()) {
        annotations = page.replaceKeyAndGetNew("/Annots", Object::newArray());
    }
    annotations.appendItem(field);
    Object form = Object::parse("<< /SigFlags 3 >>");  // there are signatures; changes are appended only
    Object fields = Object::newArray();
    fields.appendItem(field);
    form.replaceKey("/Fields", fields);
    pdf.getRoot().replaceKey("/AcroForm", form);
}

struct Written {
    Bytes bytes;
    std::size_t signature_at = 0;  ///< where the object of the signature begins
};

Written write(QPDF& pdf, Object signature) {
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    // What the PDF/A checks saw stays as it is: streams are copied, and the identifier follows from the content.
    writer.setStreamDataMode(qpdf_s_preserve);
    writer.setObjectStreamMode(qpdf_o_preserve);
    writer.setNewlineBeforeEndstream(true);
    writer.setDeterministicID(true);
    writer.write();
    const std::shared_ptr<Buffer> buffer = writer.getBufferSharedPointer();
    const QPDFObjGen number = writer.getRenumberedObjGen(signature.getObjGen());
    const std::map<QPDFObjGen, QPDFXRefEntry> table = writer.getWrittenXRefTable();
    const auto found = table.find(number);
    if (found == table.end() || found->second.getType() != 1) {
        throw std::runtime_error("qpdf did not write the signature as an object of its own");
    }
    return {.bytes = Bytes(reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()),
            .signature_at = static_cast<std::size_t>(found->second.getOffset())};
}

std::size_t position(const Bytes& bytes, const std::string& text, std::size_t from) {
    const std::size_t at = bytes.find(text, from);
    if (at == Bytes::npos) {
        throw std::runtime_error("qpdf wrote the signature in a way that is not expected: no " + text);
    }
    return at;
}

/// Puts a text over another, filled up with blanks to its length.
void put(Bytes& bytes, std::size_t at, std::size_t length, const std::string& text) {
    bytes.replace(at, length, text + std::string(length - text.size(), ' '));
}

}  // namespace

Bytes sign_pdf(const Bytes& pdf, const Signer& signer, std::int64_t signing_time) {
    require_in_force(signer, signing_time);
    QPDF document;
    document.setSuppressWarnings(true);
    document.setAttemptRecovery(false);
    try {
        document.processMemoryFile("PDF", pdf.data(), pdf.size());
        document.getAllPages().at(0);
    } catch (const std::bad_alloc&) {
        throw;  // says nothing about the PDF
    } catch (const std::exception& failure) {
        refuse_pdf("GC-SIGN-0041", std::string("cannot be read: ") + failure.what(), "sign_pdf signs a sound PDF",
                   "make the document again");
    }
    if (document.isEncrypted()) {
        refuse_pdf("GC-SIGN-0041", "encrypted", "sign_pdf signs an open PDF", "remove the encryption");
    }
    if (document.getRoot().hasKey("/AcroForm")) {
        refuse_pdf("GC-SIGN-0042", "it has a form, perhaps a signature already",
                   "writing a PDF again would break a signature that it has",
                   "sign the document before any signature, once");
    }
    const std::size_t room = room_for(signer);
    const Object signature = signature_dictionary(document, room, signing_time);
    add_field(document, signature);
    Written written = write(document, signature);
    require_whole_memory(document);

    Bytes& bytes = written.bytes;
    const std::string placeholder = std::to_string(k_position_to_come);
    const std::string range = "[ 0 " + placeholder + ' ' + placeholder + ' ' + placeholder + " ]";
    const std::string contents = '<' + std::string(2 * room, '0') + '>';
    const std::size_t range_at = position(bytes, range, written.signature_at);
    const std::size_t contents_at = position(bytes, contents, written.signature_at);
    const std::size_t after = contents_at + contents.size();
    // The positions must have the same length as what stood in their place: one byte more would move everything behind
    // it, and the table of positions in the PDF would be wrong.
    put(bytes, range_at, range.size(),
        "[ 0 " + std::to_string(contents_at) + ' ' + std::to_string(after) + ' ' +
            std::to_string(bytes.size() - after) + " ]");

    // The ByteRange is within the signed bytes, so it is filled in first. The value alone stands in the gap.
    const Bytes cms = detached_cms(encoding::sha256_bytes(bytes.substr(0, contents_at) + bytes.substr(after)), signer);
    if (cms.size() > room) {
        throw std::runtime_error("the CMS signature is longer than the room for it");
    }
    bytes.replace(contents_at + 1, 2 * cms.size(), encoding::hexadecimal(cms));
    return std::move(bytes);
}

}  // namespace gumcert::signing
