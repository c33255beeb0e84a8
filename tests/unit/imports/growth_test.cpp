// Law: the work of reading a digital certificate grows as its length, whatever is in it.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/dcc_reader.h"
#include "signing/verify.h"
#include "tests/support/growth.h"

namespace gumcert::imports {
namespace {

std::string hostile_certificate(const std::string& data, const std::string& attributes = "") {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<dcc:digitalCalibrationCertificate "
           "xmlns:dcc=\"https://ptb.de/dcc\" "
           "xmlns:si=\"https://ptb.de/si\" schemaVersion=\"3.3.0\"" +
           attributes +
           "><dcc:measurementResults><dcc:measurementResult><dcc:results><dcc:result><dcc:name><dcc:content "
           "lang=\"en\">r</dcc:content></dcc:name><dcc:data>" +
           data +
           "</dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>"
           "</dcc:digitalCalibrationCertificate>\n";
}

std::string hostile_quantity(const std::string& name, const std::string& inside) {
    return "<dcc:quantity><dcc:name><dcc:content lang=\"en\">" + name + "</dcc:content></dcc:name>" + inside +
           "</dcc:quantity>";
}

const std::string k_hostile_real = "<si:real><si:value>1</si:value><si:unit>\\metre</si:unit></si:real>";

std::string hostile_repeated(std::size_t n, const std::function<std::string(std::size_t)>& part) {
    std::string all;
    for (std::size_t i = 0; i < n; ++i) {
        all += part(i);
    }
    return all;
}

struct Hostile {
    const char* name;
    std::size_t n;
    std::string (*make)(std::size_t n);
};

const Hostile k_hostile[] = {
    {"quantities of one name", 1500,
     [](std::size_t n) {
         return hostile_certificate(
             hostile_repeated(n, [](std::size_t) { return hostile_quantity("x", k_hostile_real); }));
     }},
    {"quantities of many names", 1500,
     [](std::size_t n) {
         return hostile_certificate(hostile_repeated(
             n, [](std::size_t i) { return hostile_quantity("x" + std::to_string(i), k_hostile_real); }));
     }},
    {"attributes of one tag", 20'000,
     [](std::size_t n) {
         return hostile_certificate(
             "", hostile_repeated(n, [](std::size_t i) { return " a" + std::to_string(i) + "=\"\""; }));
     }},
    {"ampersands in an attribute", 200'000,
     [](std::size_t n) {
         return hostile_certificate("", " a=\"" + hostile_repeated(n, [](std::size_t) { return "&amp;"; }) + "\"");
     }},
    {"forms of one quantity", 3000,
     [](std::size_t n) {
         return hostile_certificate(hostile_quantity(
             "x", "<si:hybrid>" + hostile_repeated(n, [](std::size_t) { return k_hostile_real; }) + "</si:hybrid>"));
     }},
    {"languages of one name", 5000,
     [](std::size_t n) {
         return hostile_certificate(
             "<dcc:quantity><dcc:name>" +
             hostile_repeated(
                 n, [](std::size_t i) { return "<dcc:content lang=\"x" + std::to_string(i) + "\">a</dcc:content>"; }) +
             "</dcc:name>" + k_hostile_real + "</dcc:quantity>");
     }},
    {"numbers of one list", 10'000,
     [](std::size_t n) {
         return hostile_certificate(hostile_quantity(
             "x", "<si:realListXMLList><si:valueXMLList>" + hostile_repeated(n, [](std::size_t) { return "1 "; }) +
                      "1</si:valueXMLList><si:unitXMLList>\\metre</si:unitXMLList></si:realListXMLList>"));
     }},
    {"deep nesting", 50'000,
     [](std::size_t n) {
         return hostile_certificate(hostile_repeated(n, [](std::size_t) { return "<a>"; }) +
                                    hostile_repeated(n, [](std::size_t) { return "</a>"; }));
     }},
    {"empty elements", 20'000,
     [](std::size_t n) { return hostile_certificate(hostile_repeated(n, [](std::size_t) { return "<a/>"; })); }},
};

template <class Work>
void expect_linear(const Work& work) {
    for (const Hostile& hostile : k_hostile) {
        const auto quietly = [&](const std::string& bytes) {
            try {
                work(bytes);
            } catch (const gum::InputError&) {  // to refuse it is as good
            }
        };
        const double growth = test::growth_of(hostile.n, hostile.make, quietly, test::k_linear);
        EXPECT_LT(growth, test::k_linear) << hostile.name;
    }
}

TEST(Growth, ReadingACertificateIsLinear) {
    expect_linear([](const std::string& bytes) { (void)reports::read_dcc(bytes, "hostile.xml"); });
}

TEST(Growth, VerifyingACertificateIsLinear) {
    const signing::TrustedMaterial nobody;
    expect_linear([&](const std::string& bytes) {
        (void)signing::verify_signatures(bytes, "hostile.xml", nobody, 1'800'000'000);
    });
}

}  // namespace
}  // namespace gumcert::imports
