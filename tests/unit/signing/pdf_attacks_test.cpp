#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "encoding/sha2.h"
#include "signing/qpdf_objects.h"
#include "signing/signer.h"
#include "signing/verify.h"
#include "tests/unit/signing/brought_material.h"
#include "tests/unit/signing/plain_pdf.h"
#include "tests/unit/signing/test_keys.h"

// What somebody without the key can do to a signed PDF, so that a reader sees another page or takes another file out
// of it than the laboratory signed. Each is not valid, and the finding says why.

namespace gumcert::signing {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using namespace test;

const std::string k_attacked_pdf_dcc =
    "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"3.3.0\">10.0023"
    "</dcc:digitalCalibrationCertificate>";

std::string text_between(const std::string& text, const std::string& from, const std::string& to) {
    const std::size_t begin = text.find(from) + from.size();
    return text.substr(begin, text.find(to, begin) - begin);
}

/// An incremental update: objects behind the end of the file, with a table that points to the one before.
Bytes updated(const Bytes& pdf, const std::vector<std::pair<int, std::string>>& objects,
              const std::string& trailer_entries = "/Root 1 0 R") {
    Bytes out = pdf;
    std::string table = "xref\n";
    int largest = 100;
    for (const auto& [number, body] : objects) {
        std::string at = std::to_string(out.size());
        at = std::string(10 - at.size(), '0') + at;
        out += std::to_string(number) + " 0 obj\n" + body + "\nendobj\n";
        table += std::to_string(number) + " 1\n" + at + " 00000 n \n";
        largest = std::max(largest, number + 1);
    }
    const std::string before = text_between(pdf.substr(pdf.rfind("startxref")), "startxref\n", "\n");
    const std::size_t table_at = out.size();
    return out + table + "trailer\n<< /Size " + std::to_string(largest) + ' ' + trailer_entries + " /Prev " + before +
           " >>\nstartxref\n" + std::to_string(table_at) + "\n%%EOF\n";
}

class PdfAttack : public testing::Test {
protected:
    [[nodiscard]] Verification verify(const Bytes& pdf) const {
        return verify_signatures(pdf, "certificate.pdf", laboratory_.trusted(), k_now);
    }
    [[nodiscard]] std::string error_of(const Bytes& pdf) const {
        try {
            const Verification verification = verify(pdf);
            if (verification.valid) {
                return "valid";
            }
            for (const auto* reports : {&verification.signatures, &verification.attachment_signatures}) {
                for (const SignatureReport& report : *reports) {
                    if (!first_error(report).empty()) {
                        return first_error(report);
                    }
                }
            }
            return verification.signatures.empty() ? "no signature" : "not valid without a reason";
        } catch (const gum::InputError& refused) {
            return refused.diagnostics().front().code;
        }
    }
    /// The file with other numbers in its ByteRange, in the room of the old ones.
    [[nodiscard]] Bytes with_range(const std::string& numbers) const {
        const std::size_t from = good_.find("/ByteRange [") + 12;
        const std::size_t room = good_.find('/', from) - from - 1;
        EXPECT_LE(numbers.size(), room);
        return Bytes(good_).replace(from, room + 1, numbers + std::string(room - numbers.size(), ' ') + "]");
    }
    /// An update with a signature of such a ByteRange, for numbers of any length.
    [[nodiscard]] Bytes with_new_range(const std::string& numbers) const {
        const int number = number_of([](QPDFObjectHandle o) { return o.isDictionary() && o.hasKey("/ByteRange"); });
        return updated(good_, {{number, "<< /Type /Sig /SubFilter /ETSI.CAdES.detached /ByteRange [" + numbers +
                                            "] /Contents <3000> >>"}});
    }
    [[nodiscard]] std::vector<std::size_t> range() const {
        QPDF document;
        document.processMemoryFile("signed", good_.data(), good_.size());
        auto array = signature_of(document).getKey("/ByteRange");
        std::vector<std::size_t> numbers;
        for (int i = 0; i < 4; ++i) {
            numbers.push_back(static_cast<std::size_t>(array.getArrayItem(i).getIntValue()));
        }
        return numbers;
    }
    [[nodiscard]] static QPDFObjectHandle signature_of(QPDF& document) {
        return document.getRoot().getKey("/AcroForm").getKey("/Fields").getArrayItem(0).getKey("/V");
    }
    /// Number of an object of the signed file that the filter takes.
    template <class Filter>
    [[nodiscard]] int number_of(Filter filter) const {
        QPDF document;
        document.processMemoryFile("signed", good_.data(), good_.size());
        for (QPDFObjectHandle object : document.getAllObjects()) {
            if (filter(object)) {
                return object.getObjectID();
            }
        }
        ADD_FAILURE() << "no such object";
        return 0;
    }

    Laboratory laboratory_{ec_key()};
    Bytes dcc_ = sign_dcc(k_attacked_pdf_dcc, *laboratory_.signer, k_signing_time);
    Bytes good_ = sign_pdf(plain_pdf(dcc_), *laboratory_.signer, k_signing_time);
};

TEST_F(PdfAttack, TheDocumentItselfIsValid) {
    EXPECT_EQ(error_of(good_), "valid");
}

TEST_F(PdfAttack, AnUpdateBehindTheSignature) {
    const int page = number_of([](QPDFObjectHandle o) { return o.isDictionaryOfType("/Page"); });
    const int file = number_of([](QPDFObjectHandle o) { return o.isStreamOfType("/EmbeddedFile"); });
    const int signature = number_of([](QPDFObjectHandle o) { return o.isDictionary() && o.hasKey("/ByteRange"); });
    const std::string other_dcc = replaced(k_attacked_pdf_dcc, "10.0023", "99");
    // Another page is shown, another file is attached, the signature is overwritten, nothing at all is changed.
    const std::vector<std::vector<std::pair<int, std::string>>> updates = {
        {{page, "<< /Type /Page /MediaBox [0 0 1 1] /Resources << >> >>"}},
        {{file, "<< /Type /EmbeddedFile /Length " + std::to_string(other_dcc.size()) + " >>\nstream\n" + other_dcc +
                    "\nendstream"}},
        {{90, "<< /Type /Action /S /JavaScript /JS (app.alert\\(1\\)) >>"}},
    };
    for (const auto& update : updates) {
        const Bytes later = updated(good_, update);
        EXPECT_EQ(error_of(later), "GC-SIGN-0142");
        EXPECT_THAT(verify(later).signatures.at(0).not_covered, Contains("nothing can be relied on"));
    }
    for (const std::string& tail : {std::string("\n"), std::string("%%EOF\n"), std::string("\0\0", 2)}) {
        EXPECT_EQ(error_of(good_ + tail), "GC-SIGN-0142");
    }
    // The signature itself is replaced by an update: one without range or content, or no signature at all.
    for (const char* body : {"<< /Type /Sig /SubFilter /ETSI.CAdES.detached /ByteRange null /Contents <> >>",
                             "<< /Type /Sig /SubFilter /ETSI.CAdES.detached /ByteRange [0 0 0 0] /Contents <> >>",
                             "<< /Type /Sig /SubFilter /ETSI.CAdES.detached /ByteRange [] >>", "<< >>", "null"}) {
        const std::string error = error_of(updated(good_, {{signature, body}}));
        EXPECT_TRUE(error == "GC-SIGN-0141" || error == "no signature") << body << ": " << error;
    }
}

TEST_F(PdfAttack, RangesThatAreNotTheWholeFile) {
    const std::vector<std::size_t> n = range();
    const auto text = [](std::vector<std::size_t> numbers) {
        std::string all;
        for (const std::size_t number : numbers) {
            all += std::to_string(number) + ' ';
        }
        return all;
    };
    const std::vector<std::string> others = {
        text({n[0], n[1], n[2]}),                  // three numbers
        text({n[0], n[1], n[2], n[3], 0, 0}),      // six
        text({1, n[1] - 1, n[2], n[3]}),           // not from the start
        text({n[0], n[1] + 1, n[2], n[3]}),        // the gap begins later, ends earlier
        text({n[0], n[1], n[2] - 1, n[3] + 1}),    //
        text({n[0], n[2] + 1, n[1], n[3]}),        // overlap
        text({n[0], n[2], n[2], n[3]}),            // no gap
        text({n[0], n[1], n[2], n[3] + 1}),        // beyond the end
        text({n[0], n[1] - 10, n[2], n[3]}),       // a larger gap, with room for something else
        text({n[0], n[1], n[2] + 10, n[3] - 10}),  //
        text({0, 0, 0, 0}),
    };
    for (const std::string& numbers : others) {
        EXPECT_EQ(error_of(with_range(numbers)), "GC-SIGN-0141") << numbers;
    }
    for (const char* numbers :
         {"0 -1 -1 -1", "0 1 9223372036854775807 1", "0 9223372036854775807 5 5",
          "0 5 9223372036854775807 9223372036854775807", "0 5 5 9223372036854775807", "-9223372036854775808 5 5 5",
          "0 5 -9223372036854775808 5", "0 9223372036854775807 -9223372036854775808 -9223372036854775808", "0 1.5 20 3",
          "(0) 5 20 3", "/a /b /c /d", "null null null null", "", "99 0 R 5 20 3"}) {
        EXPECT_EQ(error_of(with_new_range(numbers)), "GC-SIGN-0141") << numbers;
    }
    // One byte less at the end: the file would have room for more.
    EXPECT_EQ(error_of(with_range(text({n[0], n[1], n[2], n[3] - 1}))), "GC-SIGN-0142");
    // No PDF number at all.
    for (const char* numbers : {"0 99999999999999999999999999 5 5", "<< >> 1 2 3", "[0 1] 2 3"}) {
        EXPECT_NE(error_of(with_new_range(numbers)), "valid") << numbers;
    }
}

TEST_F(PdfAttack, TheGapHoldsSomethingElse) {
    const std::vector<std::size_t> n = range();
    const std::size_t last = n[2] - 1;
    // Behind the CMS: other digits, blanks, another dictionary.
    EXPECT_EQ(error_of(Bytes(good_).replace(last - 2, 2, "01")), "GC-SIGN-0143");
    EXPECT_EQ(error_of(Bytes(good_).replace(last - 1, 1, " ")), "GC-SIGN-0141");
    EXPECT_EQ(error_of(Bytes(good_).replace(last - 20, 21, "> /Rect [0 0 99 99] <>")), "GC-SIGN-0141");
    EXPECT_EQ(error_of(Bytes(good_).replace(n[1], n[2] - n[1], '<' + std::string(n[2] - n[1] - 2, '0') + '>')),
              "GC-SIGN-0143");
    EXPECT_EQ(error_of(Bytes(good_).replace(n[1] + 1, 8, "30820001")), "GC-SIGN-0143");
}

/// A value of DER.
Bytes tlv(unsigned tag, const Bytes& content) {
    Bytes size;
    for (std::size_t rest = content.size(); rest != 0; rest >>= 8U) {
        size.insert(size.begin(), static_cast<char>(rest & 255U));
    }
    if (content.size() >= 128) {
        size.insert(size.begin(), static_cast<char>(0x80U | size.size()));
    }
    return Bytes(1, static_cast<char>(tag)) + (content.empty() ? Bytes(1, '\0') : size) + content;
}
/// The values within a value, each whole.
std::vector<Bytes> values_in(const Bytes& whole) {
    const auto read = [](const Bytes& bytes, std::size_t from, std::size_t& header) {
        const auto* const begin = reinterpret_cast<const unsigned char*>(bytes.data()) + from;
        const unsigned char* at = begin;
        long length = 0;
        int tag = 0;
        int type = 0;
        ASN1_get_object(&at, &length, &tag, &type, static_cast<long>(bytes.size() - from));
        header = static_cast<std::size_t>(at - begin);
        return header + static_cast<std::size_t>(length);
    };
    std::size_t header = 0;
    const std::size_t end = read(whole, 0, header);
    std::vector<Bytes> values;
    for (std::size_t at = header; at < end;) {
        std::size_t ignored = 0;
        const std::size_t size = read(whole, at, ignored);
        values.push_back(whole.substr(at, size));
        at += size;
    }
    return values;
}

// Law: into no part of the CMS that its value does not cover, anything can be put, but what belongs there.
TEST_F(PdfAttack, NothingCanBeAddedWithinTheSignature) {
    const std::string digits = text_between(good_, "/Contents <", ">");
    const std::vector<Bytes> info = values_in(*encoding::bytes_from_hexadecimal(digits));
    const std::vector<Bytes> data =
        values_in(values_in(info.at(1)).at(0));  // version, digests, content, certificates, signers
    ASSERT_EQ(data.size(), 5U);
    const std::vector<Bytes> signer =
        values_in(values_in(data[4]).at(0));  // version … signed attributes, method, value
    ASSERT_EQ(signer.size(), 6U);
    const auto joined = [](const std::vector<Bytes>& values) {
        Bytes all;
        for (const Bytes& one : values) {
            all += one;
        }
        return all;
    };
    /// The file with other parts, in the room of the signature.
    const auto with = [&](const std::vector<Bytes>& parts, const std::vector<Bytes>& of_signer) {
        std::vector<Bytes> all = parts;
        all.push_back(tlv(0x31, tlv(0x30, joined(of_signer))));
        std::string hex = encoding::hexadecimal(tlv(0x30, info[0] + tlv(0xA0, tlv(0x30, joined(all)))));
        EXPECT_LE(hex.size(), digits.size());
        hex.resize(digits.size(), '0');
        return replaced(good_, digits, hex);
    };
    const std::vector<Bytes> parts(data.begin(), data.begin() + 4);
    EXPECT_EQ(error_of(with(parts, signer)), "valid");
    const auto with_part = [&](std::size_t at, const Bytes& part) {
        std::vector<Bytes> changed = parts;
        changed[at] = part;
        return with(changed, signer);
    };
    const auto with_certificate = [&](const Bytes& certificate) {
        return with_part(3, tlv(0xA0, joined(values_in(parts[3])) + certificate));
    };
    const auto with_lists = [&](const Bytes& lists) {
        std::vector<Bytes> changed = parts;
        changed.push_back(tlv(0xA1, lists));
        return with(changed, signer);
    };
    const auto with_attributes = [&](const Bytes& attributes) {
        std::vector<Bytes> changed = signer;
        changed.push_back(tlv(0xA1, attributes));
        return with(parts, changed);
    };
    const auto identifier = [](const char* number) {
        ASN1_OBJECT* const object = OBJ_txt2obj(number, 1);
        const Bytes bytes = encoded(object, i2d_ASN1_OBJECT);
        ASN1_OBJECT_free(object);
        return bytes;
    };
    const Bytes text = tlv(0x0C, k_sentence);
    const auto attribute = [&](const char* number, const Bytes& value) {
        return tlv(0x30, identifier(number) + tlv(0x31, value));
    };
    // Unsigned attributes.
    const char* const stamped = "1.2.840.113549.1.9.16.2.14";
    const char* const revocation = "1.2.840.113549.1.9.16.2.24";
    for (const char* const number : {"1.2.3.4", "1.2.840.113549.1.9.15.1", stamped, revocation,
                                     "1.2.840.113549.1.9.16.2.23", "1.2.840.113549.1.9.6"}) {
        EXPECT_EQ(error_of(with_attributes(attribute(number, text))), "GC-SIGN-0148") << number;
    }
    const Bytes stamp = time_stamp(authority_named("A time stamping service"));
    const Bytes with_stamp = with_attributes(attribute(stamped, stamp));
    EXPECT_EQ(error_of(with_stamp), "valid");
    EXPECT_THAT(verify(with_stamp).signatures.at(0).not_covered,
                Contains("unsigned within the signature: signature-time-stamp"));
    EXPECT_EQ(error_of(with_attributes(attribute(stamped, stamp + text))), "GC-SIGN-0148");
    EXPECT_EQ(error_of(with_attributes(attribute(stamped, stamp) + attribute("1.2.3.4", text))), "GC-SIGN-0148");
    const Bytes list = revocation_list(laboratory_.root, {});
    const Bytes of_stranger = revocation_list(authority_named("Example Root"), {});
    const Bytes with_values = with_attributes(attribute(revocation, tlv(0x30, tlv(0xA0, tlv(0x30, list)))));
    EXPECT_EQ(error_of(with_values), "valid");
    EXPECT_THAT(verify(with_values).signatures.at(0).not_covered,
                Contains("unsigned within the signature: revocation-values"));
    EXPECT_EQ(error_of(with_attributes(attribute(revocation, tlv(0x30, tlv(0xA0, tlv(0x30, of_stranger)))))),
              "GC-SIGN-0148");
    EXPECT_EQ(error_of(with_attributes(attribute(revocation, tlv(0x30, tlv(0xA2, text))))), "GC-SIGN-0148");
    // Lists of revoked certificates.
    EXPECT_EQ(error_of(with_lists(list)), "valid");
    EXPECT_THAT(verify(with_lists(list)).signatures.at(0).not_covered,
                Contains("unsigned within the signature: lists of revoked certificates"));
    const Bytes answer = revocation_answer(laboratory_.own, laboratory_.root, laboratory_.root);
    EXPECT_EQ(error_of(with_lists(tlv(0xA1, identifier("1.3.6.1.5.5.7.16.2") + answer))), "valid");
    for (const Bytes& foreign :
         {of_stranger, tlv(0xA1, identifier("1.2.3.4") + text), tlv(0xA1, identifier("1.3.6.1.5.5.7.16.2") + text)}) {
        EXPECT_NE(error_of(with_lists(foreign)), "valid");
    }
    EXPECT_EQ(error_of(with_lists(of_stranger)), "GC-SIGN-0148");
    // Certificates.
    EXPECT_EQ(error_of(with_certificate(der(laboratory_.root))), "valid");
    for (const Bytes& foreign : foreign_certificates(laboratory_)) {
        EXPECT_EQ(error_of(with_certificate(foreign)), "GC-SIGN-0124");
    }
    EXPECT_NE(error_of(with_certificate(tlv(0xA3, identifier("1.2.3.4") + text))), "valid");
    // Parameters and names of algorithms, versions, contents.
    const Bytes sha256 = values_in(values_in(parts[1]).at(0)).at(0);
    EXPECT_EQ(error_of(with_part(1, tlv(0x31, tlv(0x30, sha256 + text)))), "GC-SIGN-0148");
    EXPECT_EQ(error_of(with_part(1, tlv(0x31, tlv(0x30, sha256) + tlv(0x30, identifier("1.2.3.4"))))), "GC-SIGN-0148");
    EXPECT_EQ(error_of(with_part(1, tlv(0x31, tlv(0x30, identifier("1.2.3.4") + text)))), "GC-SIGN-0148");
    EXPECT_EQ(error_of(with_part(0, tlv(0x02, k_sentence.substr(0, 4)))), "GC-SIGN-0148");
    EXPECT_NE(error_of(with_part(2, tlv(0x30, identifier("1.2.3.4")))), "valid");
    for (const std::size_t at : {std::size_t{2}, std::size_t{4}}) {
        std::vector<Bytes> changed = signer;
        changed[at] = tlv(0x30, values_in(signer[at]).at(0) + text);
        EXPECT_NE(error_of(with(parts, changed)), "valid") << at;
    }
    std::vector<Bytes> twice = parts;
    twice.push_back(tlv(0x31, tlv(0x30, joined(signer))));
    EXPECT_NE(error_of(with(twice, signer)), "valid");
}

TEST_F(PdfAttack, ASecondSignature) {
    // Of somebody else, behind that of the laboratory.
    const std::vector<std::size_t> n = range();
    const std::string body = "<< /Type /Sig /Filter /Adobe.PPKLite /SubFilter /ETSI.CAdES.detached /ByteRange [ 0 " +
                             std::to_string(n[1]) + ' ' + std::to_string(n[2]) + ' ' + std::to_string(n[3]) +
                             " ] /Contents " + good_.substr(n[1], n[2] - n[1]) + " >>";
    const Bytes twice = updated(good_, {{90, body}});
    const Verification verification = verify(twice);
    EXPECT_FALSE(verification.valid);
    EXPECT_EQ(verification.signatures.size(), 2U);
    for (const SignatureReport& report : verification.signatures) {
        EXPECT_EQ(first_error(report), "GC-SIGN-0142");
    }
    // Signed by the laboratory with the signature of somebody else in it, which covers nothing.
    QPDF inside;
    const std::string plain = plain_pdf();
    inside.processMemoryFile("plain", plain.data(), plain.size());
    inside.getRoot().replaceKey("/Extra", inside.makeIndirectObject(QPDFObjectHandle::parse(body)));
    const Bytes both = sign_pdf(gumcert::test::written_pdf(inside), *laboratory_.signer, k_signing_time);
    EXPECT_FALSE(verify(both).valid);
}

TEST_F(PdfAttack, TheSignatureIsMovedToAnotherFile) {
    const Bytes other = sign_pdf(plain_pdf("<other/>"), *Laboratory(ec_key()).signer, k_signing_time);
    const std::string mine = text_between(good_, "/Contents <", ">");
    const std::string theirs = text_between(other, "/Contents <", ">");
    std::string moved = mine;
    moved.resize(theirs.size(), '0');
    EXPECT_EQ(error_of(replaced(other, theirs, moved)), "GC-SIGN-0117");
    // Of one document of the laboratory to another.
    const Bytes second = sign_pdf(plain_pdf("<other/>"), *laboratory_.signer, k_signing_time);
    EXPECT_EQ(error_of(replaced(second, text_between(second, "/Contents <", ">"), mine)), "GC-SIGN-0117");
}

TEST_F(PdfAttack, OtherKindsOfSignatures) {
    for (const char* kind :
         {"/adbe.x509.rsa_sha1  ", "/ETSI.RFC3161       ", "/adbe.pkcs7.sha1    ", "/etsi.cades.detached"}) {
        EXPECT_EQ(error_of(replaced(good_, "/ETSI.CAdES.detached", kind)), "GC-SIGN-0140") << kind;
    }
    EXPECT_EQ(error_of(replaced(good_, "/SubFilter", "/Subfilter")), "GC-SIGN-0140");
    EXPECT_EQ(error_of(replaced(good_, "/ByteRange", "/Byterange")), "no signature");
}

TEST_F(PdfAttack, EncryptedFilesAreRefused) {
    for (const char* password : {"", "secret"}) {
        QPDF pdf;
        pdf.processMemoryFile("signed", good_.data(), good_.size());
        QPDFWriter writer(pdf);
        writer.setOutputMemory();
        writer.setR6EncryptionParameters(password, "owner", true, true, true, true, true, true, qpdf_r3p_full, true);
        writer.write();
        const auto buffer = writer.getBufferSharedPointer();
        const Bytes encrypted(reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize());
        EXPECT_EQ(error_of(encrypted), "GC-SIGN-0052") << password;
        EXPECT_THROW(static_cast<void>(sign_pdf(encrypted, *laboratory_.signer, k_signing_time)), gum::InputError);
    }
}

TEST_F(PdfAttack, DamagedFilesNeverCrash) {
    for (std::size_t length = 0; length < good_.size(); length += 97) {
        EXPECT_NE(error_of(good_.substr(0, length)), "valid") << length;
    }
    for (std::size_t at = 9; at < good_.size(); at += 61) {
        Bytes changed = good_;
        changed.replace(at, 4, "<<[(");
        EXPECT_NE(error_of(changed), "valid") << at;
        changed = good_;
        changed.erase(at, 3);
        EXPECT_NE(error_of(changed), "valid") << at;
    }
    // In front of the file: readers look for the header within the first bytes.
    EXPECT_NE(error_of("x" + good_), "valid");
    EXPECT_NE(error_of("%PDF-1.7\n" + good_), "valid");
    EXPECT_NE(error_of("<x/>" + good_), "valid");
}

TEST_F(PdfAttack, TheAttachmentIsSignedBySomebodyElse) {
    const Laboratory stranger(ec_key());
    const Bytes theirs = sign_dcc(k_attacked_pdf_dcc, *stranger.signer, k_signing_time);
    const Bytes pdf = sign_pdf(plain_pdf(theirs), *laboratory_.signer, k_signing_time);
    EXPECT_EQ(error_of(pdf), "GC-SIGN-0130");
    EXPECT_TRUE(verify(pdf).signatures.at(0).valid);
    EXPECT_FALSE(verify(pdf).attachment_signatures.at(0).valid);
    // A signed certificate within a PDF that is not signed: the pages are nobody's.
    const Verification unsigned_pages = verify(plain_pdf(dcc_));
    EXPECT_FALSE(unsigned_pages.valid);
    EXPECT_TRUE(unsigned_pages.attachment_signatures.at(0).valid);
    EXPECT_TRUE(unsigned_pages.signatures.empty());
}

TEST_F(PdfAttack, ManySignaturesAndAttachmentsAreNotAWayToKeepTheCheckBusy) {
    std::vector<std::pair<int, std::string>> signatures;
    for (int i = 0; i < 50; ++i) {
        signatures.emplace_back(100 + i, "<< /Type /Sig /ByteRange [0 1 2 3] /Contents <> >>");
    }
    EXPECT_FALSE(verify(updated(good_, signatures)).valid);
    EXPECT_LT(verify(updated(good_, signatures)).signatures.size(), 20U);

    QPDF pdf;
    const std::string plain = plain_pdf();
    pdf.processMemoryFile("plain", plain.data(), plain.size());
    auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, dcc_);
    for (int i = 0; i < 50; ++i) {
        const std::string name = "certificate" + std::to_string(i) + ".xml";
        QPDFEmbeddedFileDocumentHelper(pdf).replaceEmbeddedFile(
            name, QPDFFileSpecObjectHelper::createFileSpec(pdf, name, stream));
    }
    const Bytes many = sign_pdf(gumcert::test::written_pdf(pdf), *laboratory_.signer, k_signing_time);
    EXPECT_EQ(error_of(many), "GC-SIGN-0145");
    EXPECT_LT(verify(many).attachment_signatures.size(), 20U);
}

TEST_F(PdfAttack, NothingIsPrintedWhateverTheFileIs) {
    // What the libraries below would say by themselves.
    QPDF pdf;
    const std::string plain = plain_pdf(dcc_);
    pdf.processMemoryFile("plain", plain.data(), plain.size());
    auto tree = pdf.getRoot().getKey("/Names").getKey("/EmbeddedFiles").getKey("/Names");
    ASSERT_TRUE(tree.isArray());
    tree.setArrayItem(1, QPDFObjectHandle::parse("/NoDictionary"));
    const std::string document = "<?xml version=\"1.0\" encoding=\"UTF-16\"?><x>";
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    EXPECT_NE(error_of(gumcert::test::written_pdf(pdf)), "valid");
    EXPECT_NE(error_of(document + std::string(4000, '\xD8') + "</x>"), "valid");
    EXPECT_NE(error_of("<?xml version=\"1.0\" encoding=\"UTF-8\"?><x>\xFF\xFE</x>"), "valid");
    EXPECT_NE(error_of(replaced(dcc_, "2001/10/xml-exc-c14n#", "2000/09/xmldsig#base64")), "valid");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(PdfAttack, TheReportCannotBeUsedToPrintOtherLines) {
    const Verification verification = verify(replaced(good_, "/ETSI.CAdES.detached", "/a#0a#1b#80:valid   "));
    ASSERT_EQ(verification.signatures.size(), 1U);
    const SignatureReport& report = verification.signatures[0];
    for (const std::string& text : {report.format, report.findings.at(0).what}) {
        for (const char* hidden : {"\n", "\x1B", "\x80"}) {
            EXPECT_THAT(text, Not(HasSubstr(hidden)));
        }
    }
}

}  // namespace
}  // namespace gumcert::signing
