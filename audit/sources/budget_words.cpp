#include "audit/sources/budget_words.h"

#include <algorithm>
#include <array>
#include <string>

#include "certificate/text_words.h"

namespace gumcert::audit {
namespace {

template <typename Meaning>
struct Word {
    std::u32string_view letters;  ///< as certificate::letters_of() gives them
    Meaning meaning;
};

using enum Column;
constexpr std::array k_column_words = {
    Word{U"quantity", quantity},
    Word{U"quantities", quantity},
    Word{U"inputquantity", quantity},
    Word{U"input", quantity},
    Word{U"component", quantity},
    Word{U"uncertaintycomponent", quantity},
    Word{U"symbol", quantity},
    Word{U"name", quantity},
    Word{U"description", quantity},
    Word{U"influence", quantity},
    Word{U"influencequantity", quantity},
    Word{U"parameter", quantity},
    Word{U"contributor", quantity},
    Word{U"sourceofuncertainty", quantity},
    Word{U"uncertaintysource", quantity},
    Word{U"grosse", quantity},
    Word{U"große", quantity},
    Word{U"grose", quantity},
    Word{U"eingangsgrosse", quantity},
    Word{U"eingangsgroße", quantity},
    Word{U"einflussgrosse", quantity},
    Word{U"einflussgroße", quantity},
    Word{U"einflußgroße", quantity},
    Word{U"komponente", quantity},
    Word{U"unsicherheitskomponente", quantity},
    Word{U"unsicherheitsquelle", quantity},
    Word{U"bezeichnung", quantity},
    Word{U"estimate", estimate},
    Word{U"bestestimate", estimate},
    Word{U"value", estimate},
    Word{U"xi", estimate},
    Word{U"x", estimate},
    Word{U"schatzwert", estimate},
    Word{U"wert", estimate},
    Word{U"unit", unit},
    Word{U"units", unit},
    Word{U"einheit", unit},
    Word{U"uora", stated},
    Word{U"aoru", stated},
    Word{U"a", stated},
    Word{U"uncertainty", stated},
    Word{U"statedvalue", stated},
    Word{U"halfwidth", stated},
    Word{U"semirange", stated},
    Word{U"limit", stated},
    Word{U"limits", stated},
    Word{U"expandeduncertainty", stated},
    Word{U"u95", stated},
    Word{U"specification", stated},
    Word{U"mpe", stated},
    Word{U"tolerance", stated},
    Word{U"valueofuncertainty", stated},
    Word{U"halbweite", stated},
    Word{U"halbbreite", stated},
    Word{U"grenze", stated},
    Word{U"unsicherheit", stated},
    Word{U"erweitertemessunsicherheit", stated},
    Word{U"erweiterteunsicherheit", stated},
    Word{U"spezifikation", stated},
    Word{U"divisor", divisor},
    Word{U"div", divisor},
    Word{U"divisork", divisor},
    Word{U"kdivisor", divisor},
    Word{U"divideby", divisor},
    Word{U"factor", divisor},
    Word{U"teiler", divisor},
    Word{U"faktor", divisor},
    Word{U"distribution", distribution},
    Word{U"probabilitydistribution", distribution},
    Word{U"probdistribution", distribution},
    Word{U"probabilitydist", distribution},
    Word{U"probdist", distribution},
    Word{U"typeofdistribution", distribution},
    Word{U"distributiontype", distribution},
    Word{U"dist", distribution},
    Word{U"distrib", distribution},
    Word{U"pdf", distribution},
    Word{U"shape", distribution},
    Word{U"verteilung", distribution},
    Word{U"wahrscheinlichkeitsverteilung", distribution},
    Word{U"verteilungsform", distribution},
    Word{U"verteilungsfunktion", distribution},
    Word{U"type", type},
    Word{U"typ", type},
    Word{U"ab", type},
    Word{U"typeab", type},
    Word{U"evaluation", type},
    Word{U"ermittlungstyp", type},
    Word{U"ui", Column::u},
    Word{U"uxi", Column::u},
    Word{U"ux", Column::u},
    Word{U"standarduncertainty", Column::u},
    Word{U"standarduncertaintyu", Column::u},
    Word{U"standarduncertaintyuxi", Column::u},
    Word{U"standarduncertaintyui", Column::u},
    Word{U"stduncertainty", Column::u},
    Word{U"stduncertaintyuxi", Column::u},
    Word{U"stdunc", Column::u},
    Word{U"standardunc", Column::u},
    Word{U"standardunsicherheit", Column::u},
    Word{U"standardunsicherheituxi", Column::u},
    Word{U"standardmessunsicherheit", Column::u},
    Word{U"stdunsicherheit", Column::u},
    Word{U"sensitivity", sensitivity},
    Word{U"sensitivitycoefficient", sensitivity},
    Word{U"sensitivitycoefficientci", sensitivity},
    Word{U"sensitivitycoeff", sensitivity},
    Word{U"senscoeff", sensitivity},
    Word{U"c", sensitivity},
    Word{U"ci", sensitivity},
    Word{U"empfindlichkeit", sensitivity},
    Word{U"sensitivitat", sensitivity},
    Word{U"empfindlichkeitskoeffizient", sensitivity},
    Word{U"sensitivitatskoeffizient", sensitivity},
    Word{U"sensitivitatskoeffizientci", sensitivity},
    Word{U"contribution", contribution},
    Word{U"uncertaintycontribution", contribution},
    Word{U"uncertaintycontributionuiy", contribution},
    Word{U"contributiontou", contribution},
    Word{U"uc", contribution},
    Word{U"cu", contribution},
    Word{U"ciui", contribution},
    Word{U"ciuxi", contribution},
    Word{U"uy", contribution},
    Word{U"uiy", contribution},
    Word{U"beitrag", contribution},
    Word{U"unsicherheitsbeitrag", contribution},
    Word{U"unsicherheitsbeitraguiy", contribution},
    Word{U"nu", Column::nu},
    Word{U"nui", Column::nu},
    Word{U"v", Column::nu},
    Word{U"vi", Column::nu},
    Word{U"dof", Column::nu},
    Word{U"df", Column::nu},
    Word{U"degreesoffreedom", Column::nu},
    Word{U"degoffreedom", Column::nu},
    Word{U"freiheitsgrade", Column::nu},
    Word{U"freiheitsgrad", Column::nu},
    Word{U"source", source},
    Word{U"reference", source},
    Word{U"certificate", source},
    Word{U"origin", source},
    Word{U"quelle", source},
    Word{U"herkunft", source},
    Word{U"kalibrierschein", source},
    Word{U"comment", comment},
    Word{U"comments", comment},
    Word{U"remark", comment},
    Word{U"remarks", comment},
    Word{U"note", comment},
    Word{U"notes", comment},
    Word{U"basis", comment},
    Word{U"how", comment},
    Word{U"explanation", comment},
    Word{U"bemerkung", comment},
    Word{U"bemerkungen", comment},
    Word{U"kommentar", comment},
    Word{U"erlauterung", comment},
    Word{U"hinweis", comment},
};

constexpr std::array k_statement_words = {
    Word{U"value", Statement::value},
    Word{U"y", Statement::value},
    Word{U"result", Statement::value},
    Word{U"measuredvalue", Statement::value},
    Word{U"measurementresult", Statement::value},
    Word{U"ergebnis", Statement::value},
    Word{U"messwert", Statement::value},
    Word{U"messergebnis", Statement::value},
    Word{U"uc", Statement::u_c},
    Word{U"ucy", Statement::u_c},
    Word{U"uy", Statement::u_c},
    Word{U"combineduncertainty", Statement::u_c},
    Word{U"combinedstandarduncertainty", Statement::u_c},
    Word{U"combinedstandarduncertaintyuc", Statement::u_c},
    Word{U"combinedstduncertainty", Statement::u_c},
    Word{U"kombiniertestandardunsicherheit", Statement::u_c},
    Word{U"kombiniertestandardmessunsicherheit", Statement::u_c},
    Word{U"kombinierteunsicherheit", Statement::u_c},
    Word{U"standardmessunsicherheit", Statement::u_c},
    Word{U"nueff", Statement::nu_eff},
    Word{U"veff", Statement::nu_eff},
    Word{U"effectivedegreesoffreedom", Statement::nu_eff},
    Word{U"effectivedof", Statement::nu_eff},
    Word{U"dofeff", Statement::nu_eff},
    Word{U"effektivefreiheitsgrade", Statement::nu_eff},
    Word{U"effektiverfreiheitsgrad", Statement::nu_eff},
    Word{U"coveragefactor", Statement::k},
    Word{U"coveragefactork", Statement::k},
    Word{U"kfactor", Statement::k},
    Word{U"erweiterungsfaktor", Statement::k},
    Word{U"erweiterungsfaktork", Statement::k},
    Word{U"expandeduncertainty", Statement::U},
    Word{U"expandeduncertaintyu", Statement::U},
    Word{U"u95", Statement::U},
    Word{U"erweitertemessunsicherheit", Statement::U},
    Word{U"erweitertemessunsicherheitu", Statement::U},
    Word{U"erweiterteunsicherheit", Statement::U},
    Word{U"ureported", Statement::reported_U},
    Word{U"reporteduncertainty", Statement::reported_U},
    Word{U"reportedu", Statement::reported_U},
    Word{U"ustated", Statement::reported_U},
    Word{U"angegebenemessunsicherheit", Statement::reported_U},
    Word{U"p", Statement::coverage_probability},
    Word{U"coverageprobability", Statement::coverage_probability},
    Word{U"levelofconfidence", Statement::coverage_probability},
    Word{U"confidencelevel", Statement::coverage_probability},
    Word{U"uberdeckungswahrscheinlichkeit", Statement::coverage_probability},
    Word{U"cmc", Statement::capability},
    Word{U"bmc", Statement::capability},
    Word{U"capability", Statement::capability},
    Word{U"calibrationandmeasurementcapability", Statement::capability},
    Word{U"kleinsteangebbaremessunsicherheit", Statement::capability},
    Word{U"lowerlimit", Statement::lower_limit},
    Word{U"lowertolerancelimit", Statement::lower_limit},
    Word{U"lsl", Statement::lower_limit},
    Word{U"tl", Statement::lower_limit},
    Word{U"unteregrenze", Statement::lower_limit},
    Word{U"upperlimit", Statement::upper_limit},
    Word{U"uppertolerancelimit", Statement::upper_limit},
    Word{U"usl", Statement::upper_limit},
    Word{U"tu", Statement::upper_limit},
    Word{U"oberegrenze", Statement::upper_limit},
    Word{U"tolerance", Statement::tolerance},
    Word{U"toleranz", Statement::tolerance},
    Word{U"mpe", Statement::tolerance},
    Word{U"fehlergrenze", Statement::tolerance},
    Word{U"nominal", Statement::nominal},
    Word{U"nominalvalue", Statement::nominal},
    Word{U"nennwert", Statement::nominal},
    Word{U"verdict", Statement::verdict},
    Word{U"conformity", Statement::verdict},
    Word{U"passfail", Statement::verdict},
    Word{U"statementofconformity", Statement::verdict},
    Word{U"konformitat", Statement::verdict},
    Word{U"bewertung", Statement::verdict},
    Word{U"decisionrule", Statement::decision_rule},
    Word{U"entscheidungsregel", Statement::decision_rule},
    Word{U"referencevalue", Statement::reference_value},
    Word{U"assignedvalue", Statement::reference_value},
    Word{U"xref", Statement::reference_value},
    Word{U"referenzwert", Statement::reference_value},
    Word{U"uref", Statement::reference_U},
    Word{U"ureference", Statement::reference_U},
    Word{U"uofreference", Statement::reference_U},
    Word{U"referenceu", Statement::reference_U},
    Word{U"referenceuncertainty", Statement::reference_U},
    Word{U"udesreferenzwerts", Statement::reference_U},
    Word{U"en", Statement::en},
    Word{U"enscore", Statement::en},
    Word{U"ennumber", Statement::en},
    Word{U"method", Statement::method},
    Word{U"procedure", Statement::method},
    Word{U"methode", Statement::method},
    Word{U"verfahren", Statement::method},
    Word{U"measurand", Statement::measurand},
    Word{U"messgrosse", Statement::measurand},
    Word{U"messgroße", Statement::measurand},
    Word{U"equation", Statement::equation},
    Word{U"model", Statement::equation},
    Word{U"measurementmodel", Statement::equation},
    Word{U"modell", Statement::equation},
    Word{U"modellgleichung", Statement::equation},
};

template <typename Meaning, std::size_t N>
std::optional<Meaning> meaning_of(const std::array<Word<Meaning>, N>& words, std::string_view text) {
    const std::u32string letters = certificate::letters_of(text);
    const auto word =
        std::find_if(words.begin(), words.end(), [&letters](const Word<Meaning>& w) { return w.letters == letters; });
    return word == words.end() ? std::nullopt : std::optional(word->meaning);
}

/// What stands before a unit or explanation in brackets: "u(xi) [µm]" and "U95 (k=2)" begin with what they are.
std::string_view without_brackets(std::string_view text) {
    const std::size_t square = text.find('[');
    if (square != std::string_view::npos && square > 0) {
        return text.substr(0, square);
    }
    const std::size_t round = text.find(" (");
    return round != std::string_view::npos && round > 0 ? text.substr(0, round) : text;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
        text.remove_prefix(1);
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == ':' || text.back() == '=')) {
        text.remove_suffix(1);
    }
    return text;
}

}  // namespace

std::optional<Column> column_of(std::string_view head) {
    head = trimmed(head);
    const std::string_view short_head = trimmed(without_brackets(head));
    for (std::string_view text = head;; text = short_head) {
        if (text == "u") {
            return Column::u;
        }
        if (text == "U" || text == "±" || text == "+/-") {
            return Column::stated;
        }
        if (const std::optional<Column> column = meaning_of(k_column_words, text)) {
            return column;
        }
        if (text == short_head) {
            return std::nullopt;
        }
    }
}

std::optional<Statement> statement_of(std::string_view name) {
    name = trimmed(name);
    const std::string_view short_name = trimmed(without_brackets(name));
    for (std::string_view text = name;; text = short_name) {
        if (text == "U" || text == "U(y)") {
            return Statement::U;
        }
        if (text == "k") {
            return Statement::k;
        }
        if (text == "u" || text == "u(y)") {
            return Statement::u_c;
        }
        if (const std::optional<Statement> statement = meaning_of(k_statement_words, text)) {
            return statement;
        }
        if (text == short_name) {
            return std::nullopt;
        }
    }
}

}  // namespace gumcert::audit
