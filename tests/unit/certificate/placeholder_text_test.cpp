#include "certificate/placeholder_text.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::certificate {
namespace {

TEST(PlaceholderText, IsAWordForNothingInFourLanguages) {
    for (const char* text : {"unknown",
                             "UNKNOWN",
                             "Un-known",
                             "none",
                             "xxx",
                             "X",
                             "see above",
                             "n/a",
                             "N. A.",
                             "not stated",
                             "-",
                             "test",
                             "Lorem ipsum",
                             "?",
                             "to be defined",
                             "not yet known",
                             "same as above",
                             "nobody",
                             "asdf",
                             "aaaa",
                             "foo bar",
                             "unbekannt",
                             "Keine Angabe",
                             "k. A.",
                             "siehe oben",
                             "entfällt",
                             "nicht bekannt",
                             "wie oben",
                             "desconocido",
                             "Ninguno",
                             "no aplica",
                             "véase arriba",
                             "ve\u0301ase arriba",
                             "sin especificar",
                             "sin datos",
                             "不明",
                             "未知",
                             "無",
                             "無無",
                             "見上",
                             "同上",
                             "不適用",
                             "ＴＢＤ",
                             "un\u00adknown",
                             "unknоwn",
                             "unknown customer",
                             "no information available"}) {
        EXPECT_TRUE(is_placeholder(text)) << text;
    }
}

TEST(PlaceholderText, IsNoTextWithAWordOfItsOwn) {
    for (const char* text : {"No damage seen",
                             "Keine Beschädigung erkennbar",
                             "Sin daños",
                             "無損傷",
                             "A",
                             "B",
                             "7",
                             "AA",
                             "III",
                             "CP-01",
                             "Serial number",
                             "Test bed 4",
                             "Testo 400",
                             "Example Customer",
                             "unknown soldier",
                             "Noether",
                             "4",
                             "0",
                             "Unbekannter Meister",
                             "good",
                             "Banana",  // three different letters: a word
                             "normal",
                             "Other Example Laboratory",
                             "Standard resistor of 1 ohm"}) {
        EXPECT_FALSE(is_placeholder(text)) << text;
    }
}

TEST(PlaceholderText, OfANameIsTheNameOfTheField) {
    for (const char* text : {"customer", "The device", "Seriennummer", "nombre del cliente", "客戶", "unknown"}) {
        EXPECT_TRUE(names_only_a_field(text)) << text;
    }
    for (const char* text : {"Customer 7", "Measuring instrument", "A", "Standard resistor"}) {
        EXPECT_FALSE(names_only_a_field(text)) << text;
    }
}

TEST(PlaceholderText, AConsentNamesWhoGaveIt) {
    for (const char* text : {"Divisor agreed.", "Teiler vereinbart.", "Divisor acordado.", "The method is accepted"}) {
        EXPECT_TRUE(is_consent_of_nobody(text)) << text;
    }
    for (const char* text :
         {"Laborleiter genehmigt.", "Qualitätsmanagerin genehmigt", "Müller genehmigt.", "QMB approved",
          "The customer agreed.", "Cliente aceptado", "Divisor agreed with the customer"}) {
        EXPECT_FALSE(is_consent_of_nobody(text)) << text;
    }
}

// Bytes that are no UTF-8 do not lead past the end.
TEST(PlaceholderText, TakesAnyBytes) {
    for (int first = 0; first < 256; ++first) {
        (void)is_placeholder(std::string(1, static_cast<char>(first)));
        (void)names_only_a_field(std::string("a") + static_cast<char>(first) + '\x80');
    }
}

}  // namespace
}  // namespace gumcert::certificate
