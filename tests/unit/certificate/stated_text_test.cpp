#include "certificate/stated_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::certificate {
namespace {

TEST(StatedText, HasALetterOrADigit) {
    for (const char* text : {"A", "7", "SN-1001", "№ 7", "Ω", "µ", "é", "範例", "مختبر", "々", "- 1", "AA", "III",
                             "serial number", "２", "😀 a"}) {
        EXPECT_TRUE(is_stated(std::string(text))) << text;
    }
}

TEST(StatedText, IsNotADashOrABlank) {
    for (const char* text :
         {"",    "-",      "—",      "–",      ".",      "…",       "?",          "---",     "/",      "()", "* * *",
          " ",   "\u00a0", "\u3000", "\u200b", "\u200d", "\u2800",  "\u3164",     "\u034f",  "\uffa0", "、", "→",
          "n/a", "N/A",    "TBD",    "none",   "xxx",    "unknown", "siehe oben", "ninguno", "未知"}) {
        EXPECT_FALSE(is_stated(std::string(text))) << text;
    }
}

TEST(StatedText, IsStatedInEveryLanguageOfIt) {
    LocalisedText text;
    EXPECT_FALSE(is_stated(text));
    text.by_language = {{"en", "Table"}, {"de", "Tisch"}};
    EXPECT_TRUE(is_stated(text));
    text.by_language = {{"en", "Table"}, {"de", "–"}};
    EXPECT_FALSE(is_stated(text));
    EXPECT_TRUE(is_stated(LocalisedText("Table")));
}

TEST(StatedText, TellsNamesFromOtherTexts) {
    for (const char* name : {"Li", "李", "Example Works", "A. B.", "Head of laboratory", "Operator 3", "3M",
                             "Other Example Laboratory", "実験室第一"}) {
        EXPECT_TRUE(is_name(std::string(name))) << name;
    }
    for (const char* text : {"L", "7", "4711", "customer", "The customer", "der Kunde", "Unknown customer",
                             "serial number", "a@example.org", "https://example.org", "www.example.org", "nobody"}) {
        EXPECT_FALSE(is_name(std::string(text))) << text;
    }
    EXPECT_FALSE(is_name(LocalisedText()));
}

/// People and firms are called like fields; roles and words for nothing stay what they are.
TEST(StatedText, TakesAnInitialOrALegalFormForASignOfAName) {
    for (const char* name : {"A. Feld",   "H. Land",     "W. Ort",     "R. Grund",           "P. Werk",
                             "R. Page",   "P. Leer",     "M. Present", "J. Folder",          "A. Mock",
                             "Open GmbH", "Werk GmbH",   "Feld AG",    "Planet GmbH",        "Halle GmbH",
                             "Home GmbH", "Testing Ltd", "Page & Co",  "Land GmbH & Co. KG", "Noch S. Leer GmbH"}) {
        EXPECT_TRUE(is_name(std::string(name))) << name;
    }
    for (const char* text :
         {"Kunde GmbH", "Customer Ltd", "Firma AG", "Unknown GmbH", "Muster GmbH", "Test GmbH", "N. N.", "Mr. X",
          "Kunde A.", "A. Name", "Feld", "Land", "Open", "GmbH", "TBD Ltd", "x. leer", "Company Ltd", "A. Unbekannt"}) {
        EXPECT_FALSE(is_name(std::string(text))) << text;
    }
}

TEST(StatedText, ComparesNamesByTheirLetters) {
    for (const char* other : {"A. Meier", "A.Meier", "a. meier", "A Meier", "A\u00a0. Meier", "А. Meier"}) {
        EXPECT_TRUE(is_same_name("A. Meier", other)) << other;
        EXPECT_TRUE(is_same_name(other, "A. Meier")) << other;
    }
    EXPECT_FALSE(is_same_name("A. Meier", "B. Meier"));
    EXPECT_FALSE(is_same_name("", ""));
    EXPECT_FALSE(is_same_name("–", "n/a")) << "two empty fields are no person";
}

TEST(StatedText, TellsIdentificationsFromOtherTexts) {
    for (const char* text : {"7", "SN-1001", "EX-0000", "2026-11", "1200", "A", "00017", "12345"}) {
        EXPECT_TRUE(is_identification(std::string(text))) << text;
    }
    for (const char* text : {"", "0", "000", "9999", "AAAA", "123456", "0123456789", "987654", "none", "serial number",
                             "a@example.org", "xxx", "S/N"}) {
        EXPECT_FALSE(is_identification(std::string(text))) << text;
    }
}

TEST(StatedText, TellsStatementsFromSingleWords) {
    for (const char* text :
         {"The item stays installed.", "Der Raum war zu warm.", "顧客不願具名於文件", "El cliente no desea figurar."}) {
        EXPECT_TRUE(is_statement(std::string(text))) << text;
    }
    for (const char* text : {"x", "because", "see above", "not needed here", "warm", "aaa bbb ccc ddd", "略",
                             "12 34 56 78 90 12 34", "a b c d e"}) {
        EXPECT_FALSE(is_statement(std::string(text))) << text;
    }
}

// Reasons that laboratories give, most of them of words that name fields as well.
TEST(StatedText, TakesPlainSentencesAsReasons) {
    for (const char* text : {"The device was dead on receipt.",
                             "The instrument was broken; there are none.",
                             "None, because the instrument was defective.",
                             "The item was not working.",
                             "The display was dead.",
                             "The item was calibrated at the customer's site.",
                             "The item was calibrated on site and not received.",
                             "Calibrated on the premises of the customer.",
                             "No item was received: calibration on site.",
                             "The measurement was made at the customer's.",
                             "The customer brought the item by himself.",
                             "The instrument is installed permanently.",
                             "The value was lost with the device.",
                             "Customer accepts it.",
                             "The customer agreed to this by e-mail.",
                             "The certificate of the manufacturer expired.",
                             "Device failed during warm-up.",
                             "The laboratory moved to another building.",
                             "The divisor was agreed with the customer.",
                             "Das Gerät war defekt.",
                             "Keine, das Gerät war bei Eingang defekt.",
                             "Gerät ohne Anzeige angeliefert.",
                             "Der Gegenstand wurde beim Kunden kalibriert.",
                             "Kalibrierung vor Ort beim Auftraggeber.",
                             "Das Gerät ist fest eingebaut.",
                             "Der Auftraggeber verlangt es so.",
                             "Gerät war defekt.",
                             "El equipo llegó averiado.",
                             "El instrumento no encendía.",
                             "Ninguno: el equipo estaba averiado.",
                             "El objeto se calibró en las instalaciones del cliente.",
                             "Calibración realizada en casa del cliente.",
                             "El cliente acepta el divisor.",
                             "El equipo queda instalado.",
                             "儀器故障，無法量測。",
                             "送校時儀器無顯示。",
                             "於客戶處校正，未收件。"}) {
        EXPECT_TRUE(is_statement(std::string(text))) << text;
    }
}

TEST(StatedText, NamesOfFieldsAloneAreNoReason) {
    const std::vector<std::string> words{
        "the",     "customer",   "device", "is",     "not",     "name",   "of",        "reason",  "unknown",
        "was",     "no",         "serial", "number", "item",    "on",     "site",      "see",     "above",
        "none",    "procedure",  "der",    "Kunde",  "ist",     "Gerät",  "unbekannt", "keine",   "Angabe",
        "wurde",   "Abweichung", "siehe",  "el",     "cliente", "objeto", "no",        "es",      "equipo",
        "ninguna", "desviación", "fue",    "método", "sample",  "Muster", "ejemplo",   "example", "said",
        "because", "there",      "were",   "weil",   "porque"};
    std::size_t next = 7;
    for (int made = 0; made < 2000; ++made) {
        std::string text;
        for (int i = 0; i < 3 + made % 6; ++i) {
            next = (next * 1103515245U + 12345U) % 2147483648U;
            const std::string& word = words[(next / 65536U) % words.size()];
            const bool of_a_draft = word == "sample" || word == "Muster" || word == "ejemplo" || word == "example";
            // Two words for a sample tell enough by themselves, as they do elsewhere.
            text += of_a_draft && i > 0 ? "the " : word + " ";
        }
        EXPECT_FALSE(is_statement(text)) << text;
    }
}

TEST(StatedText, TellsAddressesFromCountries) {
    using Lines = std::vector<std::string>;
    EXPECT_TRUE(is_postal_address(Lines{"Example Street 1", "12345 Example Town"}));
    EXPECT_TRUE(is_postal_address(Lines{"台北市信義路五段7號"}));
    EXPECT_TRUE(is_postal_address(Lines{"-", "PO Box 7, Example"}));
    for (const Lines& lines : {Lines{}, Lines{"Germany"}, Lines{"United States of America"}, Lines{"台灣"},
                               Lines{"lab@example.org"}, Lines{"see above"}, Lines{"Street", "Town"}, Lines{"1 2"}}) {
        EXPECT_FALSE(is_postal_address(lines)) << (lines.empty() ? "" : lines[0]);
    }
    EXPECT_TRUE(is_email("a@example.org"));
    for (const char* text : {"", "@", "a@", "@b.org", "a@b", "a b@c.org", "a@b@c.org", "a@b.org."}) {
        EXPECT_FALSE(is_email(text)) << text;
    }
}

// Bytes that are no UTF-8 do not lead past the end.
TEST(StatedText, TakesAnyBytes) {
    for (int first = 0; first < 256; ++first) {
        (void)is_stated(std::string(1, static_cast<char>(first)));
        std::string text(1, '-');
        text.push_back(static_cast<char>(first));
        text.push_back('\x80');
        (void)is_stated(text);
    }
}

// Standards of Europe, Ecuador, India, Australia … are named by letters that are words elsewhere.
TEST(StatedText, LettersAndANumberNameADocument) {
    for (const char* letters : {"EN", "ES", "IS", "AS", "SE", "LA", "DE", "AN", "IT", "DIN EN", "BS EN", "UNE-EN",
                                "EN ISO", "EN IEC", "OIML R", "JJG"}) {
        for (const char* number : {" 837-1", " 13160", "-837", " 60751:2022", " 10"}) {
            EXPECT_TRUE(is_name_of_document(std::string(letters) + number)) << letters << number;
        }
    }
    for (const char* text : {"en 837-1", "EN", "EN 1", "EN837", "see above", "NO 12", "ID 100", "SN 4711", "NA 12",
                             "TBD 100", "N/A", "document 12", "12", "12 EN", ""}) {
        EXPECT_FALSE(is_name_of_document(text)) << text;
    }
}

TEST(StatedReason, IsWhatAUserWouldGive) {
    for (const char* const reason : {"number not needed",
                                     "error in the serial number",
                                     "customer name missing",
                                     "item not received",
                                     "unknown customer",
                                     "typing error",
                                     "wrong date",
                                     "test",
                                     "no order",
                                     "duplicate",
                                     "order 17",
                                     "errata",
                                     "agreed",
                                     "Gerät nicht erhalten",
                                     "kein Auftrag",
                                     "Seriennummer fehlt",
                                     "Nummer nicht benötigt",
                                     "Adresse unbekannt",
                                     "Tippfehler",
                                     "Prüfling fehlt",
                                     "error en el número de serie",
                                     "equipo no recibido",
                                     "sin pedido",
                                     "número no necesario",
                                     "falta el nombre del cliente",
                                     "地址不明",
                                     "測試",
                                     "序號錯誤",
                                     "編號不需要",
                                     "未收到儀器",
                                     "客戶名稱錯誤",
                                     "錯"}) {
        EXPECT_TRUE(states_a_reason(std::string(reason))) << reason;
        EXPECT_TRUE(states_a_reason(std::string(reason) + ".")) << reason;
    }
}

TEST(StatedReason, IsNoneWhereNothingIsSaid) {
    for (const char* const nothing :
         {"",  " ",     "-",   "\u2014", "...",   "?",      "n/a",    "N. A.", "Ｎ／Ａ", "tbd", "TBC",    "xxx",
          "x", "k. A.", "s/d", "none",   "None.", "\u3000", "\u200B", "17",    "asdf",   "無",  "不適用", "待定"}) {
        EXPECT_FALSE(states_a_reason(std::string(nothing))) << nothing;
    }
}

TEST(StatedReason, IsStatedInEveryLanguage) {
    LocalisedText text;
    EXPECT_FALSE(states_a_reason(text));
    text.by_language.emplace_back("en", "serial number missing");
    EXPECT_TRUE(states_a_reason(text));
    text.by_language.emplace_back("de", "k. A.");
    EXPECT_FALSE(states_a_reason(text));
    text.plain = "serial number missing";
    EXPECT_FALSE(states_a_reason(text));
}

}  // namespace
}  // namespace gumcert::certificate
