#include "audit/words/budget_words.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>
#include <utility>

#include "audit/stated_number.h"
#include "audit/word_line.h"
#include "audit/words/unit_words.h"
#include "certificate/text_words.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

template <typename Meaning>
struct Word {
    std::u32string_view letters;  ///< as certificate::letters_of() gives them
    Meaning meaning;
};
template <typename Meaning>  // as the compiler finds it itself, but for Clang 14
Word(std::u32string_view, Meaning)->Word<Meaning>;

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
    Word{U"uncertaintycontributor", quantity},
    Word{U"errorsource", quantity},
    Word{U"variable", quantity},
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
    Word{U"unsicherheitseinfluss", quantity},
    Word{U"fehlerquelle", quantity},
    Word{U"einfluss", quantity},
    Word{U"ursache", quantity},
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
    Word{U"grenzwert", stated},
    Word{U"fehlergrenze", stated},
    Word{U"fehlergrenzen", stated},
    Word{U"unsicherheit", stated},
    Word{U"erweitertemessunsicherheit", stated},
    Word{U"erweiterteunsicherheit", stated},
    Word{U"spezifikation", stated},
    Word{U"divisor", divisor},
    Word{U"div", divisor},
    Word{U"divisork", divisor},
    Word{U"kdivisor", divisor},
    Word{U"ki", divisor},
    Word{U"kordivisor", divisor},
    Word{U"divisorork", divisor},
    Word{U"koderteiler", divisor},
    Word{U"teileroderk", divisor},
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
    Word{U"uk", Column::u},  // U/k
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
    Word{U"sens", sensitivity},
    Word{U"senscoef", sensitivity},
    Word{U"senskoeff", sensitivity},
    Word{U"senskoeffizient", sensitivity},
    Word{U"sensitivitatskoeff", sensitivity},
    Word{U"empfindlichkeitskoeff", sensitivity},
    Word{U"sensitivityfactor", sensitivity},
    Word{U"empfindlichkeitsfaktor", sensitivity},
    Word{U"c", sensitivity},
    Word{U"ci", sensitivity},
    Word{U"empfindlichkeit", sensitivity},
    Word{U"empf", sensitivity},
    Word{U"sensitivitat", sensitivity},
    Word{U"empfindlichkeitskoeffizient", sensitivity},
    Word{U"sensitivitatskoeffizient", sensitivity},
    Word{U"sensitivitatskoeffizientci", sensitivity},
    Word{U"contribution", contribution},
    Word{U"uncertaintycontribution", contribution},
    Word{U"uncertaintycontributionuiy", contribution},
    Word{U"contributiontou", contribution},
    Word{U"contributiontouc", contribution},
    Word{U"beitragzurunsicherheit", contribution},
    Word{U"contrib", contribution},
    Word{U"uncertaintycontrib", contribution},
    Word{U"productcu", contribution},
    Word{U"produktcu", contribution},
    Word{U"uc", contribution},
    Word{U"cu", contribution},
    Word{U"ciui", contribution},
    Word{U"ciuxi", contribution},
    Word{U"uy", contribution},
    Word{U"uiy", contribution},
    Word{U"beitrag", contribution},
    Word{U"unsicherheitsbeitrag", contribution},
    Word{U"unsichbeitrag", contribution},
    Word{U"unsicherheitsbeitraguiy", contribution},
    Word{U"nu", Column::nu},
    Word{U"nui", Column::nu},
    Word{U"v", Column::nu},
    Word{U"vi", Column::nu},
    Word{U"viorveff", Column::nu},
    Word{U"viveff", Column::nu},
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

/// Those of Spanish, French, Chinese and of published tables: words that have one meaning alone. An array of more than 256 words has no
/// type that Clang 14 finds itself.
constexpr std::array k_further_column_words = {
    Word{U"componentname", quantity},
    Word{U"nameofcomponent", quantity},
    Word{U"standarduncertaintycomponent", quantity},
    Word{U"uncertaintysources", quantity},
    Word{U"sourcesofuncertainty", quantity},
    Word{U"magnitud", quantity},
    Word{U"magnituddeentrada", quantity},
    Word{U"magnitudesdeentrada", quantity},
    Word{U"magnituddeinfluencia", quantity},
    Word{U"fuentedeincertidumbre", quantity},
    Word{U"fuentesdeincertidumbre", quantity},
    Word{U"componente", quantity},
    Word{U"componentedeincertidumbre", quantity},
    Word{U"descripcion", quantity},
    Word{U"simbolo", quantity},
    Word{U"grandeur", quantity},
    Word{U"grandeurdentree", quantity},
    Word{U"grandeursdentree", quantity},
    Word{U"grandeurdinfluence", quantity},
    Word{U"sourcedincertitude", quantity},
    Word{U"sourcesdincertitude", quantity},
    Word{U"composante", quantity},
    Word{U"composantedincertitude", quantity},
    Word{U"designation", quantity},
    Word{U"symbole", quantity},
    Word{U"輸入量", quantity},
    Word{U"输入量", quantity},
    Word{U"影響量", quantity},
    Word{U"影响量", quantity},
    Word{U"不確定度來源", quantity},
    Word{U"不确定度来源", quantity},
    Word{U"estimacion", estimate},
    Word{U"mejorestimacion", estimate},
    Word{U"valorestimado", estimate},
    Word{U"valor", estimate},
    Word{U"estimation", estimate},
    Word{U"valeur", estimate},
    Word{U"valeurestimee", estimate},
    Word{U"估計值", estimate},
    Word{U"估计值", estimate},
    Word{U"unidad", unit},
    Word{U"unidades", unit},
    Word{U"unite", unit},
    Word{U"unites", unit},
    Word{U"單位", unit},
    Word{U"单位", unit},
    Word{U"semiancho", stated},
    Word{U"semiamplitud", stated},
    Word{U"semiintervalo", stated},
    Word{U"incertidumbre", stated},
    Word{U"incertidumbreexpandida", stated},
    Word{U"limite", stated},
    Word{U"especificacion", stated},
    Word{U"tolerancia", stated},
    Word{U"demietendue", stated},
    Word{U"demilargeur", stated},
    Word{U"incertitude", stated},
    Word{U"incertitudeelargie", stated},
    Word{U"emt", stated},
    Word{U"半寬", stated},
    Word{U"半寬度", stated},
    Word{U"半宽", stated},
    Word{U"半宽度", stated},
    Word{U"擴充不確定度", stated},
    Word{U"扩展不确定度", stated},
    Word{U"diviseur", divisor},
    Word{U"除數", divisor},
    Word{U"除数", divisor},
    Word{U"distribucion", distribution},
    Word{U"distribuciondeprobabilidad", distribution},
    Word{U"tipodedistribucion", distribution},
    Word{U"loi", distribution},
    Word{U"loidedistribution", distribution},
    Word{U"loideprobabilite", distribution},
    Word{U"typedeloi", distribution},
    Word{U"typededistribution", distribution},
    Word{U"分布", distribution},
    Word{U"分佈", distribution},
    Word{U"機率分布", distribution},
    Word{U"機率分佈", distribution},
    Word{U"機率分配", distribution},
    Word{U"概率分布", distribution},
    Word{U"tipo", type},
    Word{U"valueofstandarduncertainty", Column::u},
    Word{U"incertidumbretipica", Column::u},
    Word{U"incertidumbreestandar", Column::u},
    Word{U"incertidumbretipicau", Column::u},
    Word{U"incertidumbreestandaru", Column::u},
    Word{U"incertitudetype", Column::u},
    Word{U"incertitudetypeu", Column::u},
    Word{U"標準不確定度", Column::u},
    Word{U"标准不确定度", Column::u},
    Word{U"coeficientedesensibilidad", sensitivity},
    Word{U"coefdesensibilidad", sensitivity},
    Word{U"coefsensibilidad", sensitivity},
    Word{U"sensibilidad", sensitivity},
    Word{U"coefficientdesensibilite", sensitivity},
    Word{U"coefdesensibilite", sensitivity},
    Word{U"coefsensibilite", sensitivity},
    Word{U"sensibilite", sensitivity},
    Word{U"靈敏係數", sensitivity},
    Word{U"靈敏度係數", sensitivity},
    Word{U"敏感係數", sensitivity},
    Word{U"灵敏系数", sensitivity},
    Word{U"灵敏度系数", sensitivity},
    Word{U"contribucion", contribution},
    Word{U"contribucionalaincertidumbre", contribution},
    Word{U"contribuciondeincertidumbre", contribution},
    Word{U"contribucionalaincertidumbretipica", contribution},
    Word{U"contribucionalaincertidumbreestandar", contribution},
    Word{U"contributionalincertitude", contribution},
    Word{U"contributionalincertitudetype", contribution},
    Word{U"不確定度貢獻", contribution},
    Word{U"不确定度贡献", contribution},
    Word{U"gradosdelibertad", Column::nu},
    Word{U"gdl", Column::nu},
    Word{U"degresdeliberte", Column::nu},
    Word{U"ddl", Column::nu},
    Word{U"自由度", Column::nu},
    Word{U"origen", source},
    Word{U"certificado", source},
    Word{U"origine", source},
    Word{U"certificat", source},
    Word{U"comentario", comment},
    Word{U"comentarios", comment},
    Word{U"observaciones", comment},
    Word{U"nota", comment},
    Word{U"notas", comment},
    Word{U"commentaire", comment},
    Word{U"commentaires", comment},
    Word{U"remarque", comment},
    Word{U"remarques", comment},
    Word{U"備註", comment},
    Word{U"备注", comment},
    Word{U"說明", comment},
    Word{U"说明", comment},
};

constexpr std::array k_statement_words = {
    Word{U"value", Statement::value},
    Word{U"y", Statement::value},
    Word{U"result", Statement::value},
    Word{U"measuredvalue", Statement::value},
    Word{U"measurementresult", Statement::value},
    Word{U"resultado", Statement::value},
    Word{U"resultat", Statement::value},
    Word{U"結果", Statement::value},
    Word{U"结果", Statement::value},
    Word{U"ergebnis", Statement::value},
    Word{U"messwert", Statement::value},
    Word{U"messergebnis", Statement::value},
    Word{U"uc", Statement::u_c},
    Word{U"ucy", Statement::u_c},
    Word{U"uy", Statement::u_c},
    Word{U"combineduncertainty", Statement::u_c},
    Word{U"combined", Statement::u_c},
    Word{U"totaluncertainty", Statement::u_c},
    Word{U"gesamtunsicherheit", Statement::u_c},
    Word{U"combinedstandarduncertainty", Statement::u_c},
    Word{U"combinedstandarduncertaintyuc", Statement::u_c},
    Word{U"combinedstduncertainty", Statement::u_c},
    Word{U"kombiniertestandardunsicherheit", Statement::u_c},
    Word{U"kombiniertestandardmessunsicherheit", Statement::u_c},
    Word{U"kombinierteunsicherheit", Statement::u_c},
    Word{U"standardmessunsicherheit", Statement::u_c},
    Word{U"standarduncertainty", Statement::u_c},
    Word{U"standardunsicherheit", Statement::u_c},
    Word{U"wc", Statement::u_c},
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
    Word{U"k95", Statement::k},
    Word{U"k99", Statement::k},
    Word{U"kp", Statement::k},
    Word{U"kfaktor", Statement::k},
    Word{U"t95", Statement::k},
    Word{U"t99", Statement::k},
    Word{U"tfactor", Statement::k},
    Word{U"tfaktor", Statement::k},
    Word{U"studentfactor", Statement::k},
    Word{U"studentsfactor", Statement::k},
    Word{U"studentfaktor", Statement::k},
    Word{U"erweiterungsfaktor", Statement::k},
    Word{U"erweiterungsfaktork", Statement::k},
    Word{U"expanded", Statement::U},
    Word{U"expandeduncertainty", Statement::U},
    Word{U"expandeduncertaintyu", Statement::U},
    Word{U"u95", Statement::U},
    Word{U"u99", Statement::U},
    Word{U"erweitertemessunsicherheit", Statement::U},
    Word{U"erweitertemessunsicherheitu", Statement::U},
    Word{U"erweiterteunsicherheit", Statement::U},
    Word{U"ucalculated", Statement::U},
    Word{U"calculatedu", Statement::U},
    Word{U"uberechnet", Statement::U},
    Word{U"calculatedexpandeduncertainty", Statement::U},
    Word{U"berechnetemessunsicherheit", Statement::U},
    Word{U"ureported", Statement::reported_U},
    Word{U"uangegeben", Statement::reported_U},
    Word{U"statedu", Statement::reported_U},
    Word{U"statedexpandeduncertainty", Statement::reported_U},
    Word{U"reportedexpandeduncertainty", Statement::reported_U},
    Word{U"expandeduncertaintyreported", Statement::reported_U},
    Word{U"angegebeneerweitertemessunsicherheit", Statement::reported_U},
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
    Word{U"modelequation", Statement::equation},
    Word{U"measurementequation", Statement::equation},
    Word{U"modell", Statement::equation},
    Word{U"modellgleichung", Statement::equation},
    Word{U"incertidumbretipicacombinada", Statement::u_c},
    Word{U"incertidumbretipicacombinadauc", Statement::u_c},
    Word{U"incertidumbretipicacombinadauy", Statement::u_c},
    Word{U"incertidumbreestandarcombinada", Statement::u_c},
    Word{U"incertidumbreestandarcombinadauc", Statement::u_c},
    Word{U"incertidumbrecombinada", Statement::u_c},
    Word{U"incertidumbrecombinadauc", Statement::u_c},
    Word{U"incertitudetypecomposee", Statement::u_c},
    Word{U"incertitudetypecomposeeuc", Statement::u_c},
    Word{U"incertitudetypecomposeeuy", Statement::u_c},
    Word{U"incertitudecomposee", Statement::u_c},
    Word{U"incertitudetypecombinee", Statement::u_c},
    Word{U"incertitudecombinee", Statement::u_c},
    Word{U"組合標準不確定度", Statement::u_c},
    Word{U"組合標準不確定度uc", Statement::u_c},
    Word{U"組合不確定度", Statement::u_c},
    Word{U"合成標準不確定度", Statement::u_c},
    Word{U"合成标准不确定度", Statement::u_c},
    Word{U"合成标准不确定度uc", Statement::u_c},
    Word{U"gradosdelibertadefectivos", Statement::nu_eff},
    Word{U"gradosefectivosdelibertad", Statement::nu_eff},
    Word{U"degresdeliberteeffectifs", Statement::nu_eff},
    Word{U"nombreeffectifdedegresdeliberte", Statement::nu_eff},
    Word{U"有效自由度", Statement::nu_eff},
    Word{U"factordecobertura", Statement::k},
    Word{U"factordecoberturak", Statement::k},
    Word{U"facteurdelargissement", Statement::k},
    Word{U"facteurdelargissementk", Statement::k},
    Word{U"涵蓋因子", Statement::k},
    Word{U"涵蓋因子k", Statement::k},
    Word{U"擴充係數", Statement::k},
    Word{U"包含因子", Statement::k},
    Word{U"包含因子k", Statement::k},
    Word{U"incertidumbreexpandida", Statement::U},
    Word{U"incertidumbreexpandidau", Statement::U},
    Word{U"incertitudeelargie", Statement::U},
    Word{U"incertitudeelargieu", Statement::U},
    Word{U"擴充不確定度", Statement::U},
    Word{U"擴充不確定度u", Statement::U},
    Word{U"擴展不確定度", Statement::U},
    Word{U"擴展不確定度u", Statement::U},
    Word{U"扩展不确定度", Statement::U},
    Word{U"扩展不确定度u", Statement::U},
    Word{U"probabilidaddecobertura", Statement::coverage_probability},
    Word{U"niveldeconfianza", Statement::coverage_probability},
    Word{U"probabilitedecouverture", Statement::coverage_probability},
    Word{U"niveaudeconfiance", Statement::coverage_probability},
    Word{U"信賴水準", Statement::coverage_probability},
    Word{U"置信水准", Statement::coverage_probability},
    Word{U"包含概率", Statement::coverage_probability},
    Word{U"涵蓋機率", Statement::coverage_probability},
};

/// Columns that budgets have beside those that an audit reads: shares, squares, numbers of rows.
constexpr std::array k_unused_columns = {
    Word{U"reading", true},
    Word{U"readings", true},
    Word{U"ablesung", true},
    Word{U"ablesungen", true},
    Word{U"lectura", true},
    Word{U"lecturas", true},
    Word{U"share", true},
    Word{U"shares", true},
    Word{U"index", true},
    Word{U"anteil", true},
    Word{U"anteile", true},
    Word{U"percent", true},
    Word{U"percentage", true},
    Word{U"prozent", true},
    Word{U"no", true},
    Word{U"nr", true},
    Word{U"number", true},
    Word{U"nummer", true},
    Word{U"pos", true},
    Word{U"position", true},
    Word{U"item", true},
    Word{U"row", true},
    Word{U"line", true},
    Word{U"zeile", true},
    Word{U"rank", true},
    Word{U"rang", true},
    Word{U"id", true},
    Word{U"variance", true},
    Word{U"varianz", true},
    Word{U"u2", true},
    Word{U"uc2", true},
    Word{U"cu2", true},
    Word{U"ciui2", true},
    Word{U"ui2", true},
    Word{U"square", true},
    Word{U"squares", true},
    Word{U"proportion", true},
    Word{U"weight", true},
    Word{U"weighting", true},
    Word{U"gewicht", true},
    Word{U"relativecontribution", true},
    Word{U"relativerbeitrag", true},
    Word{U"contributionpercent", true},
    Word{U"date", true},
    Word{U"datum", true},
    Word{U"numero", true},
    Word{U"項次", true},
    Word{U"序號", true},
    Word{U"序号", true},
};

/// Names of the value of a result that is a deviation. An input quantity may be called so as well.
constexpr std::array k_deviation_words = {
    Word{U"deviation", Statement::value},
    Word{U"measureddeviation", Statement::value},
    Word{U"error", Statement::value},
    Word{U"errorofindication", Statement::value},
    Word{U"indicationerror", Statement::value},
    Word{U"errorofmeasurement", Statement::value},
    Word{U"measurementerror", Statement::value},
    Word{U"correction", Statement::value},
    Word{U"abweichung", Statement::value},
    Word{U"anzeigeabweichung", Statement::value},
    Word{U"messabweichung", Statement::value},
    Word{U"korrektion", Statement::value},
    Word{U"korrektur", Statement::value},
    Word{U"desviacion", Statement::value},
    Word{U"errordeindicacion", Statement::value},
    Word{U"errordemedicion", Statement::value},
    Word{U"correccion", Statement::value},
    Word{U"偏差", Statement::value},
    Word{U"示值誤差", Statement::value},
    Word{U"示值误差", Statement::value},
    Word{U"器差", Statement::value},
    Word{U"修正值", Statement::value},
};

/// Names of the value of a result that no input quantity has: a reading may be called "measured value".
constexpr std::array k_result_words = {
    Word{U"y", Statement::value},
    Word{U"result", Statement::value},
    Word{U"measurementresult", Statement::value},
    Word{U"resultado", Statement::value},
    Word{U"resultat", Statement::value},
    Word{U"結果", Statement::value},
    Word{U"结果", Statement::value},
    Word{U"ergebnis", Statement::value},
    Word{U"messergebnis", Statement::value},
};

template <typename Meaning>
using Dictionary = std::unordered_map<std::u32string_view, Meaning>;
template <typename Meaning, std::size_t N>
Dictionary<Meaning> dictionary_of(const std::array<Word<Meaning>, N>& words) {
    Dictionary<Meaning> meanings;
    for (const Word<Meaning>& word : words) {
        meanings.emplace(word.letters, word.meaning);  // the first one of a word
    }
    return meanings;
}

template <const auto& words>
auto meaning_of_letters(const std::u32string& letters) -> std::optional<decltype(words[0].meaning)> {
    static const auto meanings = dictionary_of(words);
    const auto word = meanings.find(letters);
    return word == meanings.end() ? std::nullopt : std::optional(word->second);
}
template <const auto& words>
auto meaning_of(std::string_view text) {
    return meaning_of_letters<words>(certificate::letters_of(text));
}

std::optional<Column> column_word(std::string_view text) {
    const std::u32string letters = certificate::letters_of(text);
    const std::optional<Column> column = meaning_of_letters<k_column_words>(letters);
    return column ? column : meaning_of_letters<k_further_column_words>(letters);
}

}  // namespace

bool is_of_other_language(std::string_view head) {
    const std::u32string letters = certificate::letters_of(head);
    constexpr char32_t k_first_ideograph = U'\u3400', k_last_ideograph = U'\u9FFF';
    if (std::any_of(letters.begin(), letters.end(),
                    [](char32_t letter) { return letter >= k_first_ideograph && letter <= k_last_ideograph; })) {
        return true;
    }
    constexpr std::array<std::u32string_view, 20> k_parts{
        U"incertidumbre", U"incertitude", U"sensibilidad", U"sensibilite", U"contribucion",
        U"distribucion",  U"coeficiente", U"unidad",       U"grandeur",    U"diviseur",
        U"valeur",        U"composante",  U"estimacion",   U"semiancho",   U"semiintervalo",
        U"demietendue",   U"demilargeur", U"tolerancia",   U"degresdelib", U"gradosdelib"};
    constexpr std::array<std::u32string_view, 12> k_whole{U"magnitud", U"componente", U"fuente", U"valor",
                                                          U"unite",    U"loi",        U"origen", U"origine",
                                                          U"simbolo",  U"symbole",    U"limite", U"descripcion"};
    return std::find(k_whole.begin(), k_whole.end(), letters) != k_whole.end() ||
           std::any_of(k_parts.begin(), k_parts.end(),
                       [&letters](std::u32string_view part) { return letters.find(part) != std::u32string::npos; });
}

namespace {

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

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}
bool is_of_number(char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == ',';
}

/// The number that k is by words that begin at a place: "k = 2", "k(95 %) = 2", "coverage factor of 2".
std::string_view number_of_k(std::string_view text, std::size_t at) {
    if (at > 0 && (is_letter(text[at - 1]) || text[at - 1] == '_')) {
        return {};
    }
    constexpr std::string_view k_words[] = {"k95",
                                            "k_95",
                                            "kp",
                                            "k_p",
                                            "k",
                                            "coverage factor",
                                            "Coverage factor",
                                            "Erweiterungsfaktor",
                                            "erweiterungsfaktor",
                                            "COVERAGE FACTOR",
                                            "ERWEITERUNGSFAKTOR",
                                            "K"};
    for (const std::string_view word : k_words) {
        if (!text.substr(at).starts_with(word)) {
            continue;
        }
        std::string_view behind = text.substr(at + word.size());
        if (word == "K" && !trimmed(behind).starts_with('=')) {
            continue;  // "EXPANDED UNCERTAINTY (K = 2)"; else it is a kelvin
        }
        if (!behind.empty() && (is_letter(behind.front()) || is_of_number(behind.front()) || behind.front() == '_')) {
            continue;
        }
        for (bool any = true; any;) {
            any = false;
            for (const std::string_view filler : {" ", "=", ":", "k ", "k=", "of ", "von ", "is ", "ist "}) {
                if (behind.starts_with(filler)) {
                    behind.remove_prefix(filler == "k=" ? 1 : filler.size());
                    any = true;
                }
            }
        }
        const std::optional<LeadingNumber> number = read_leading_number(behind, "", Percent::unit);
        constexpr double k_largest = 20.0;
        if (number && number->number.value > 0.0 && number->number.value < k_largest &&
            !number->rest.starts_with('%')) {
            return behind;
        }
    }
    return {};
}

/// Whether what follows a name begins with what is said of coverage: ", k=2", " (95 %", " 95,45 %".
bool begins_with_coverage(std::string_view text) {
    while (!text.empty() &&
           (text.front() == ' ' || text.front() == ',' || text.front() == ';' || text.front() == '(')) {
        text.remove_prefix(1);
    }
    if (text.empty()) {
        return false;
    }
    for (const std::string_view word : {"with ", "mit ", "at ", "for ", "für ", "p = ", "p="}) {
        if (text.starts_with(word)) {
            return coverage_in(text).says_any();
        }
    }
    const bool is_number = text.front() >= '0' && text.front() <= '9';
    return is_number ? coverage_in(text.substr(0, text.find('%') + 1)).p.has_value() : !number_of_k(text, 0).empty();
}

/// Whether an input quantity may have the name of a statement.
bool may_be_quantity(Statement statement, std::string_view text) {
    switch (statement) {
        case Statement::u_c:
        case Statement::nu_eff:
        case Statement::U:
        case Statement::reported_U:
            return false;
        case Statement::k:
            return text.size() <= 3;
        case Statement::value:
            return !meaning_of<k_result_words>(text);
        default:
            return true;
    }
}

}  // namespace

namespace {

/// A symbol behind the word of a head: "X_i", "u(x)", "dT/dx", "a".
bool is_symbol(std::string_view word) {
    constexpr std::size_t k_longest = 12;
    if (word.empty() || word.size() > k_longest || word.find('%') != std::string_view::npos) {
        return false;
    }
    for (const std::string_view small :
         {"of", "in", "by", "to", "at", "or", "an", "on", "is", "de", "zu", "im", "am"}) {
        if (word == small) {
            return false;
        }
    }
    if (word.find_first_of("_(/|^") != std::string_view::npos || word.find("·") != std::string_view::npos) {
        return true;
    }
    const auto letters = std::count_if(word.begin(), word.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    return letters <= 2 && is_letter(word.front());
}

/// A head before its unit, "Contribution / nm" and "Beitrag in µm"; the whole where it has none. What is divided over something is
/// no unit.
std::string_view without_unit(std::string_view head) {
    for (const std::string_view sign : {" / ", " in "}) {
        const std::size_t at = head.rfind(sign);
        if (at == std::string_view::npos || at == 0) {
            continue;
        }
        const std::string rest(trimmed(head.substr(at + sign.size())));
        const bool is_unit = known_unit(rest).has_value();
        const bool may_be =
            sign == " / " && rest.find(' ') == std::string::npos && (rest == "U" || rest == "a" || !column_word(rest));
        if (is_unit || may_be) {
            return trimmed(head.substr(0, at));
        }
    }
    return head;
}

std::optional<Column> meaning_of_head(std::string_view text) {
    if (text == "u" || text == "u_xx") {  // the latter in ISO 14253-2
        return Column::u;
    }
    if (text == "U" || text == "±" || text == "+/-") {
        return Column::stated;
    }
    return column_word(text);
}

}  // namespace

namespace {

/// "(c·u)²", "u_i²(y)", "c²u²": squares of u or of contributions, by their symbols.
bool is_square(std::string_view head) {
    std::string bare;
    bool has_power = false;
    for (std::size_t at = 0; at < head.size();) {
        std::size_t power = 0;
        for (const std::string_view sign : {"²", "^2"}) {
            power = head.substr(at).starts_with(sign) ? sign.size() : power;
        }
        has_power = has_power || power > 0;
        bare += power > 0 ? "" : std::string(head.substr(at, 1));
        at += std::max<std::size_t>(power, 1);
    }
    if (!has_power) {
        return false;
    }
    const std::optional<Column> column = meaning_of_head(trimmed(bare));
    return column == Column::u || column == Column::contribution;
}

}  // namespace

std::optional<LimitHead> limit_head(std::string_view head) {
    if (head.find_first_of("0123456789=") != std::string_view::npos) {
        return std::nullopt;
    }
    std::string_view bare = head.substr(0, head.find_first_of("([/,"));
    while (bare.ends_with(' ')) {
        bare.remove_suffix(1);
    }
    const std::string_view symbol = bare.substr(bare.find_last_of(' ') + 1);  // npos + 1 is 0
    constexpr std::array<std::string_view, 3> k_upper_symbols{"a+", "a₊", "a_+"};
    constexpr std::array<std::string_view, 5> k_lower_symbols{"a-", "a−", "a₋", "a_-", "a_−"};
    if (std::find(k_upper_symbols.begin(), k_upper_symbols.end(), symbol) != k_upper_symbols.end()) {
        return LimitHead::upper;
    }
    if (std::find(k_lower_symbols.begin(), k_lower_symbols.end(), symbol) != k_lower_symbols.end()) {
        return LimitHead::lower;
    }
    const std::u32string letters = certificate::letters_of(bare);
    constexpr std::array<std::u32string_view, 5> k_lower{U"lower", U"lowerlimit", U"lowerbound", U"untergrenze",
                                                         U"unteregrenze"},
        k_upper{U"upper", U"upperlimit", U"upperbound", U"obergrenze", U"oberegrenze"};
    if (std::find(k_lower.begin(), k_lower.end(), letters) != k_lower.end()) {
        return LimitHead::lower;
    }
    return std::find(k_upper.begin(), k_upper.end(), letters) != k_upper.end() ? std::optional(LimitHead::upper)
                                                                               : std::nullopt;
}

bool is_unused_column(std::string_view head) {
    head = trimmed(head);
    const auto has_letters = std::any_of(head.begin(), head.end(), is_letter);
    if (!has_letters) {
        return true;  // "%", "#"
    }
    for (const std::string_view text : {head, trimmed(without_brackets(head)), without_unit(head)}) {
        const std::size_t end = text.find_last_not_of("% ");
        const bool is_share = end + 1 < text.size() && meaning_of_head(text.substr(0, end + 1)) == Column::contribution;
        if (is_share || is_square(text) || meaning_of<k_unused_columns>(text)) {
            return true;
        }
    }
    return false;
}

namespace {

/// A number with a unit in a head, behind a space, a bracket or "@".
struct PointOfHead {
    std::size_t at = std::string_view::npos;  ///< where it begins
    std::string text;                         ///< "10 V"
};
PointOfHead point_of(std::string_view head) {
    for (std::size_t at = head.find_first_of("0123456789"); at != std::string_view::npos && at > 0;
         at = head.find_first_of("0123456789", head.find_first_not_of("0123456789.,", at))) {
        const char before = head[at - 1];
        const std::string_view part = head.substr(at, head.find_first_of(")],;", at) - at);
        const std::optional<LeadingNumber> number = before == ' ' || before == '(' || before == '[' || before == '@'
                                                        ? read_leading_number(part, "", Percent::unit)
                                                        : std::nullopt;
        const std::string unit =
            number ? unit_in_rest(number->rest.substr(0, std::min(number->rest.find(" in "), number->rest.find(" / "))))
                   : std::string();
        if (!unit.empty() && known_unit(unit)) {
            return {.at = at, .text = number->number.text + " " + unit};
        }
    }
    return {};
}

}  // namespace

std::string point_in_head(std::string_view head) {
    return point_of(head).text;
}

bool is_relative_symbol(std::string_view head) {
    const std::string_view symbol = trimmed(without_brackets(without_unit(trimmed(head))));
    return is_one_of(symbol, {"w", "w_i", "wi", "w(xi)", "w(x_i)"});
}

bool is_of_relative_uncertainty(std::string_view head) {
    if (is_relative_symbol(head)) {
        return true;
    }
    for (const std::string_view text :
         {trimmed(head), trimmed(without_unit(trimmed(head))), trimmed(without_brackets(head))}) {
        std::string lower = text::in_small_letters(std::string(text));
        std::erase_if(lower, [](char c) { return c == ' ' || c == '_' || c == '|' || c == ',' || c == '.'; });
        if (is_one_of(lower, {"urel", "ur", "rsu", "relu", "u(x)/x", "u(xi)/xi", "u(y)/y", "u/x", "ui/xi", "u(q)/q"})) {
            return true;
        }
    }
    const std::string whole = text::in_small_letters(std::string(head));
    for (const std::string_view share : {"contrib", "share", "beitrag", "anteil"}) {
        if (whole.find(share) != std::string::npos) {
            return false;  // "Relative contribution to uncertainty"
        }
    }
    const bool is_relative = whole.find("relativ") != std::string::npos || whole.starts_with("rel. ") ||
                             whole.starts_with("rel ") || whole.starts_with("relat. ");
    return is_relative && (whole.find("uncert") != std::string::npos || whole.find("unc.") != std::string::npos ||
                           whole.find("unsich") != std::string::npos || whole.find(" u") != std::string::npos);
}

std::optional<Column> relative_column_of(std::string_view head, std::string_view unit_of_numbers) {
    head = trimmed(head);
    const std::string of_head = unit_in_head(std::string(head));
    if (!of_head.empty() && head.ends_with(" " + of_head) && !head.ends_with("/ " + of_head)) {
        head = trimmed(head.substr(0, head.size() - of_head.size()));  // "Relative standard uncertainty %"
    }
    const std::optional<gum::Unit> unit = known_unit(of_head.empty() ? std::string(unit_of_numbers) : of_head);
    if (!unit || !unit->dimension().is_one()) {
        return std::nullopt;
    }
    for (const std::string_view word :
         {"relative ", "Relative ", "rel. ", "Rel. ", "relativer ", "Relativer ", "relat. ", "Relat. "}) {
        if (head.starts_with(word)) {
            return column_of(head.substr(word.size()));
        }
    }
    return is_relative_symbol(head) ? std::optional(Column::u) : std::nullopt;
}

std::optional<Column> column_of(std::string_view head) {
    head = trimmed(head);
    // "u_i ≡ |c_i| u(x_i) (nm)": a symbol and what it stands for (JCGM 100:2008, table H.1).
    if (const std::size_t at = head.find(" ≡ "); at != std::string_view::npos && at > 0) {
        return column_of(head.substr(0, at));
    }
    // "u bei 10 V", "Contribution 10 V": of one of several points beside each other.
    if (const std::size_t at = point_of(head).at; at != std::string_view::npos && head[at - 1] != '(') {
        std::string_view name = trimmed(head.substr(0, at));
        for (const std::string_view word : {" at", " bei", " for", " für", " @", "@", " en", " a"}) {
            if (name.ends_with(word)) {
                name = trimmed(name.substr(0, name.size() - word.size()));
                break;
            }
        }
        const std::optional<Column> column = column_of(name);
        if (column == Column::u || column == Column::contribution) {
            return column;
        }
    }
    // "Value ± kPa", "ui(P) ± kPa": the layout of M3003, where ± says that the column has uncertainties, and what follows is
    // their unit. What is headed "Value" there is divided; it is no estimate.
    constexpr std::string_view k_plus_minus = "±";
    if (const std::size_t at = head.find(k_plus_minus); at != std::string_view::npos && at > 0) {
        const std::string_view name = trimmed(head.substr(0, at));
        if (name.starts_with("ui(") || name.starts_with("u_i(")) {  // u_i(y) of any y
            return Column::contribution;
        }
        const std::optional<Column> column = column_of(name);
        return column == Column::estimate ? std::optional(Column::stated) : column;
    }
    // "ui(V)" of any V that is no input: u_i(y) of the result.
    for (const std::string_view symbol : {"ui(", "u_i("}) {
        const std::size_t close = head.find(')');
        if (head.starts_with(symbol) && close != std::string_view::npos && close > symbol.size()) {
            const std::string_view of = head.substr(symbol.size(), close - symbol.size());
            const bool is_whole = close + 1 == head.size() || without_unit(head).size() == close + 1 ||
                                  trimmed(without_brackets(head)).size() == close + 1;
            if (is_whole && !of.starts_with('x') && !of.starts_with('X') && is_symbol(of)) {
                return Column::contribution;
            }
        }
    }
    const std::string_view bare = without_unit(head);
    const std::string_view texts[] = {head, trimmed(without_brackets(head)), bare, trimmed(without_brackets(bare))};
    std::size_t length = std::string_view::npos;
    for (const std::string_view text : texts) {
        // Most heads have neither unit nor brackets, and are four times the same.
        if (text.size() != std::exchange(length, text.size())) {
            if (const std::optional<Column> column = meaning_of_head(text)) {
                return column;
            }
        }
    }
    for (const std::string_view text : texts) {  // "Half-width a or U": both are what is divided
        for (const std::string_view word : {" or ", " oder ", " bzw. "}) {
            const std::size_t at = text.find(word);
            if (at == std::string_view::npos || at == 0 || text.find(word, at + 1) != std::string_view::npos) {
                continue;
            }
            const std::optional<Column> column = column_of(text.substr(0, at));
            if (column && column == column_of(text.substr(at + word.size()))) {
                return column;
            }
        }
    }
    for (const std::string_view text : texts) {
        const std::size_t at = text.rfind(' ');
        if (at == std::string_view::npos || at == 0 || !is_symbol(text.substr(at + 1))) {
            continue;
        }
        const std::string_view symbol = text.substr(at + 1);
        std::string_view before = trimmed(text.substr(0, at));
        before = before.ends_with(',') ? trimmed(before.substr(0, before.size() - 1)) : before;  // "u, mm"
        const std::optional<Column> column = meaning_of_head(before);
        if (column == Column::stated && symbol.front() == 'u') {  // "Uncertainty u(x)"
            const std::optional<Column> of_symbol = meaning_of_head(symbol);
            return of_symbol ? of_symbol : Column::u;
        }
        // "Uncertainty component u_xx [µm]" (ISO 14253-2): what has a unit is no name.
        if (column == Column::quantity && symbol.front() == 'u' && known_unit(unit_in_head(std::string(head)))) {
            return Column::u;
        }
        if (column) {
            return column;
        }
    }
    return std::nullopt;
}

namespace {

/// What is said of coverage as one of U: k above those of u_c, or a probability above 68 %.
bool is_of_expanded(const CoverageText& coverage) {
    constexpr double k_least_k = 1.6, k_least_p = 0.9;
    const std::optional<LeadingNumber> k =
        coverage.k.empty() ? std::nullopt : read_leading_number(coverage.k, "", Percent::unit);
    return k ? k->number.value >= k_least_k : coverage.p.has_value() && *coverage.p >= k_least_p;
}

}  // namespace

bool says_coverage_alone(std::string_view text) {
    constexpr std::string_view k_between = " ()[],;:=\t\n";
    constexpr std::string_view k_words =
        " k p t u w u95 u_95 u_c uc ν_eff nu_eff veff v_eff normal gaussian gauß coverage "
        "factor probability level confidence approx approx. ca. with mit and und for für at bei "
        "in of the des vom value measured measurement reading rdg result measurand indication "
        "messwert messwerts messwertes ergebnis ergebnisses erweiterungsfaktor "
        "überdeckungswahrscheinlichkeit überdeckungsfaktor ";
    for (std::size_t at = text.find_first_not_of(k_between); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(k_between, at), text.size());
        const std::string token(text.substr(at, end - at));
        at = text.find_first_not_of(k_between, end);
        const bool has_letter = std::any_of(
            token.begin(), token.end(), [](char c) { return is_letter(c) || static_cast<unsigned char>(c) >= 0x80U; });
        const bool is_number = token.front() >= '0' && token.front() <= '9';
        if (has_letter && !is_number && !is_unit_of_part(token) && token != "–" && token != "—" && token != "≈" &&
            k_words.find(" " + text::in_small_letters(token) + " ") == k_words.npos) {
            return false;
        }
    }
    return true;
}

namespace {

/// What a name in words says of an uncertainty: "standard uncertainty of the result", "Overall uncertainty", "Messunsicherheit U".
/// Nothing where it may be that of anything else, "uncertainty of calibration", or is one of the two only with its coverage, and
/// that says nothing.
/// \param coverage     what follows it, "(k = 2)"
/// \param is_relative  set where the name says so
std::optional<Statement> uncertainty_in_words(std::string_view name, std::string_view coverage, bool& is_relative) {
    constexpr std::size_t k_longest = 80;
    bool is_standard = false, is_expanded = false, is_total = false, is_noun = false;
    bool is_tail = false, has_tail = false;  // behind "of"
    if (name.size() > k_longest) {
        return std::nullopt;
    }
    for (std::size_t at = 0; at < name.size();) {
        const std::size_t end = std::min(name.find(' ', at), name.size());
        const std::string_view symbol = name.substr(at, end - at);
        const std::string word = text::in_small_letters(symbol);
        at = name.find_first_not_of(' ', end);
        at = at == std::string_view::npos ? name.size() : at;
        if (is_tail) {
            const bool names_result =
                is_one_of(word, {"result", "results", "measurement", "measurand", "output", "ergebnisses",
                                 "messergebnisses", "messung", "messgröße", "messgrösse"});
            has_tail = has_tail || names_result;
            if (!has_tail && !is_one_of(word, {"the", "a", "des", "der", "dem"})) {
                return std::nullopt;
            }
            if (has_tail && !names_result &&
                !is_one_of(symbol, {"u", "U", "u_c", "uc", "u(y)", "U(y)", "u_c(y)", "uc(y)"})) {
                return std::nullopt;
            }
        } else if (is_one_of(word, {"of", "des", "der", "von"}) && is_noun) {
            is_tail = true;
        } else if (is_one_of(word, {"expanded", "extended", "erweiterte"})) {
            is_expanded = true;
        } else if (!is_noun && is_one_of(word, {"relative", "rel.", "relat."})) {
            is_relative = true;
        } else if (is_one_of(word, {"standard", "std", "std."})) {
            is_standard = true;
        } else if (is_one_of(word, {"combined", "overall", "total", "resulting", "final", "kombinierte", "gesamte",
                                    "resultierende"})) {
            is_total = true;
        } else if (is_one_of(word, {"uncertainty", "unsicherheit", "messunsicherheit"})) {
            is_noun = true;
        } else if (is_one_of(word, {"standardunsicherheit", "standardmessunsicherheit"})) {
            is_noun = is_standard = true;
        } else if (is_one_of(word, {"gesamtunsicherheit", "gesamtmessunsicherheit"})) {
            is_noun = is_total = true;
        } else if ((is_noun || is_expanded || is_total) && is_one_of(symbol, {"U", "U(y)", "U95", "U_95", "W"})) {
            is_noun = is_expanded = true;  // "Expanded U"; that of a "Standard U" is the standard
        } else if ((is_noun || is_total) &&
                   is_one_of(symbol, {"u", "u_c", "uc", "u(y)", "u_c(y)", "uc(y)", "w", "w_c", "wc"})) {
            is_noun = is_standard = true;
        } else if (word != "measurement") {
            return std::nullopt;
        }
    }
    const CoverageText said = coverage_in(coverage);
    is_noun = is_noun || (is_total && !said.k.empty());  // "Total (k = 1)": no contribution is called so
    if (!is_noun || (is_tail && !has_tail) || (is_standard && is_expanded)) {
        return std::nullopt;
    }
    if (is_expanded || (!is_standard && is_of_expanded(said))) {
        return Statement::U;
    }
    // "Measurement uncertainty" alone may be that of a certificate, in a row.
    return is_standard || is_total || said.says_any() || has_tail ? std::optional(Statement::u_c) : std::nullopt;
}

constexpr std::string_view k_signs_of_product[] = {"·", "×", "*", "⋅", "x "};
constexpr std::string_view k_signs_of_equality[] = {"=", "≅", "≈", "≃"};

/// The symbol or number at the beginning that may be a coverage factor; empty where there is none.
std::string_view leading_factor(std::string_view text) {
    for (const std::string_view k : {"k", "t_95", "t95", "t_p", "t"}) {
        if (text.starts_with(k)) {
            return text.substr(0, k.size());
        }
    }
    return text.substr(0, text.find_first_not_of("0123456789.,"));
}

/// What "U =" is a product of.
struct FactorOfU {
    std::string_view factor;  ///< the number or "k"; empty where it is no product
    bool is_last = false;     ///< it stands behind u
};

/// Of "k·u_c", "2 · u(y)" or "u_c·k". Nothing where something is added to it.
FactorOfU factor_of_u(std::string_view product) {
    product = trimmed(product);
    if (product.find_first_of("+|-/") != std::string_view::npos) {
        return {};
    }
    const auto is_u = [](std::string_view text) {
        return text == "u" || text.starts_with("u_") || text.starts_with("uc") || text.starts_with("u(");
    };
    if (is_u(product)) {
        for (const std::string_view sign : k_signs_of_product) {
            if (const std::size_t at = product.find(sign); at != std::string_view::npos) {
                const std::string_view behind = trimmed(product.substr(at + sign.size()));
                const std::string_view factor = leading_factor(behind);
                return {.factor = factor == behind ? factor : std::string_view(), .is_last = true};
            }
        }
        return {};
    }
    const std::string_view factor = leading_factor(product);
    std::string_view behind = product.substr(factor.size());
    bool has_sign = false;
    const auto take = [&](std::string_view sign) {
        const bool is_next = behind.starts_with(sign);
        behind.remove_prefix(is_next ? sign.size() : 0);
        has_sign = has_sign || is_next;
        return is_next;
    };
    while (take(" ") || std::any_of(std::begin(k_signs_of_product), std::end(k_signs_of_product), take)) {
    }
    return {.factor = has_sign && is_u(behind) ? factor : std::string_view()};
}

/// What k is in a product of numbers.
struct FactorInNumbers {
    std::string_view k;           ///< empty where none is known
    std::string_view other = {};  ///< what may be k as well, and the first one u
    bool is_open = false;         ///< one of the numbers is k, and nothing says which
};

bool may_be_k(double number) {
    return number >= 1.0 && number <= 14.0;
}

double value_of(std::string_view digits) {
    const std::optional<StatedNumber> number = read_number(std::string(digits), "");
    return number ? number->value : 0.0;
}

/// Which of two factors is k, where the first one stands where k does in symbols.
/// \param has_unit  the second one, which is u
FactorInNumbers factor_of_two(std::string_view first, std::string_view second, bool has_unit) {
    const double one = value_of(first), other = value_of(second);
    if (may_be_k(one) && (has_unit || !may_be_k(other) || one == other)) {
        return {.k = first};
    }
    if (has_unit || !may_be_k(other)) {
        return {.k = {}, .is_open = true};
    }
    // Both may be k: the usual one before the other, else the first as in "k·u"; u_c of the rows tells whether it is.
    if (!may_be_k(one)) {
        return {.k = second};
    }
    const auto is_usual_k = [](double number) {
        constexpr std::array k_usual{1.64, 1.645, 1.65, 1.96, 2.0, 2.576, 2.58, 3.0};
        return std::find(k_usual.begin(), k_usual.end(), number) != k_usual.end();
    };
    const bool is_second = is_usual_k(other) && !is_usual_k(one);
    return {.k = is_second ? second : first, .other = is_second ? first : second};
}

/// 2 of "k · u(y) = 2 × 37.7 mg", as EA-4/02 writes U; of "k·u_c = 0.0651·2", too, where u is no k. Nothing where no product of
/// numbers follows.
/// \param is_last  k stands behind u: "u_c·k = 37.7 mg · 2"
FactorInNumbers factor_in_numbers(std::string_view product, bool is_last) {
    const std::size_t equal = product.find('=');
    const std::string_view numbers =
        equal == std::string_view::npos ? std::string_view() : trimmed(product.substr(equal + 1));
    const auto leading = [](std::string_view text) { return text.substr(0, text.find_first_not_of("0123456789.,")); };
    const std::string_view first = leading(numbers);
    for (const std::string_view times : k_signs_of_product) {
        const std::size_t at = numbers.find(times);
        if (first.empty() || at == std::string_view::npos) {
            continue;
        }
        const std::string_view unit = trimmed(numbers.substr(first.size(), at - first.size()));
        const std::string_view rest = trimmed(numbers.substr(at + times.size())), second = leading(rest);
        if (is_last && !second.empty() && unit.find('=') == std::string_view::npos) {
            return factor_of_two(second, first, !unit.empty());
        }
        if (is_last || !unit.empty()) {
            continue;
        }
        if (second.empty()) {  // "2 × (0.05² + 0.03²)^(1/2)", "2 × √0.0034 mV"
            const bool is_sum = rest.starts_with('(') || rest.starts_with("√") || rest.starts_with("sqrt");
            const bool is_k = may_be_k(value_of(first));
            return {.k = is_sum && is_k ? first : std::string_view(), .is_open = is_sum && !is_k};
        }
        const std::string_view behind = trimmed(rest.substr(second.size()));
        const bool has_unit =
            !behind.empty() && std::none_of(std::begin(k_signs_of_equality), std::end(k_signs_of_equality),
                                            [behind](std::string_view sign) { return behind.starts_with(sign); });
        return factor_of_two(first, second, has_unit);
    }
    return {};
}

/// 59 mg of "k·u(m_X) = 2·29.3 mg ≅ 59 mg"; empty where a product ends the text.
std::string_view number_at_end(std::string_view product) {
    std::size_t last = std::string_view::npos, behind = 0;
    for (const std::string_view sign : k_signs_of_equality) {
        const std::size_t at = product.rfind(sign);
        if (at != std::string_view::npos && (last == std::string_view::npos || at > last)) {
            last = at;
            behind = at + sign.size();
        }
    }
    const std::string_view number =
        last == std::string_view::npos ? std::string_view() : trimmed(product.substr(behind));
    const bool is_product =
        std::any_of(std::begin(k_signs_of_product), std::end(k_signs_of_product),
                    [number](std::string_view times) { return number.find(times) != std::string_view::npos; });
    return number.empty() || !is_of_number(number.front()) || is_product ? std::string_view() : number;
}

/// What follows a part of a name.
std::string_view behind_of(std::string_view name, std::string_view part) {
    return name.substr(static_cast<std::size_t>(part.data() - name.data()) + part.size());
}

/// Of a name that is a statement as it stands, or before what it has in brackets.
/// \param further  what is said of coverage behind it
std::optional<NamedStatement> whole_statement(std::string_view name, std::string_view further = {}) {
    name = trimmed(name);
    const std::string_view short_name = trimmed(without_brackets(name));
    for (std::string_view text = name;; text = short_name) {
        std::optional<NamedStatement> named;
        if (text == "U" || text == "U(y)" || text == "W") {  // W is a relative U (ISO 376)
            named = NamedStatement{.statement = Statement::U, .may_be_quantity = text != "U(y)"};
        } else if (text.starts_with("U(") && text.find(')') + 1 == text.size() &&
                   is_of_expanded(coverage_in(std::string(behind_of(name, text)) + std::string(further)))) {
            named = NamedStatement{.statement = Statement::U};  // "U(f) k = 2"
        } else if (text == "k") {
            named = NamedStatement{.statement = Statement::k, .may_be_quantity = true};
        } else if (text == "u" || text == "u(y)") {
            named = NamedStatement{.statement = Statement::u_c, .may_be_quantity = text == "u"};
        } else if (text.starts_with("u_c(") || text.starts_with("uc(")) {
            named = NamedStatement{.statement = Statement::u_c};
        } else if (const std::optional<Statement> statement = meaning_of<k_statement_words>(text)) {
            named = NamedStatement{.statement = *statement, .may_be_quantity = may_be_quantity(*statement, text)};
            if ((*statement == Statement::k || *statement == Statement::U) && text.ends_with("99")) {
                named->coverage = "99 %";  // "U99", "k_99": 95 % is what is taken where nothing is said
            }
        } else if (meaning_of<k_deviation_words>(text)) {
            named = NamedStatement{.statement = Statement::value, .may_be_quantity = true, .may_be_constant = true};
        }
        if (const std::size_t at = text.rfind(' '); !named && at != std::string_view::npos && at > 0) {
            // "Error of indication E", "Result c"
            const std::string_view word = trimmed(text.substr(0, at));
            if (is_symbol(text.substr(at + 1)) &&
                (meaning_of<k_deviation_words>(word) || meaning_of<k_result_words>(word))) {
                named = NamedStatement{.statement = Statement::value, .may_be_quantity = true, .may_be_constant = true};
            }
        }
        const std::string_view behind = behind_of(name, text);
        const std::string coverage = std::string(behind) + std::string(further);
        bool is_relative = false;
        if (const std::optional<Statement> by_words = uncertainty_in_words(text, coverage, is_relative);
            by_words && (!named || named->statement == Statement::u_c)) {
            named = NamedStatement{.statement = *by_words,
                                   .is_relative = is_relative,
                                   .says_of_what = is_relative && !says_coverage_alone(coverage)};
        }
        if (named) {
            if (coverage_in(behind).says_any()) {
                named->coverage = behind;
                named->may_be_quantity = false;
            }
            return named;
        }
        if (text == short_name) {
            return std::nullopt;
        }
    }
}

/// \param may_have_unit  behind the name; one is taken off, and not another one behind that
std::optional<NamedStatement> statement_named(std::string_view name, bool may_have_unit) {
    name = trimmed(name);
    // "Result: (10.0020 ± 0.0047) bar": brackets about a value and its U explain no name.
    const std::size_t plus_minus = std::min(name.find("±"), name.find("+/-"));
    if (const std::size_t sign = name.find_first_of("=:"); sign < plus_minus && plus_minus != name.npos) {
        std::optional<NamedStatement> named = whole_statement(name.substr(0, sign));
        if (named && named->statement == Statement::value) {
            named->assigned = trimmed(name.substr(sign + 1));
            return named;
        }
    }
    if (std::optional<NamedStatement> whole = whole_statement(name)) {
        return whole;
    }
    constexpr std::size_t k_longest = 200;
    if (name.size() > k_longest) {
        return std::nullopt;
    }
    // "Expanded uncertainty / dB, k = 2", "U mm (k = 2)": the unit stands behind the name.
    for (const std::string_view sign : {" / ", " in ", " "}) {
        const std::string of_name = sign == " " && may_have_unit ? unit_in_head(std::string(name)) : std::string();
        const bool is_sought = may_have_unit && (sign != " " || !of_name.empty());
        const std::size_t at = is_sought ? name.find(std::string(sign) + of_name) : std::string_view::npos;
        if (at == std::string_view::npos || at == 0) {
            continue;
        }
        const std::string_view behind = name.substr(at + sign.size());
        const std::size_t end = std::min(behind.find_first_of(" ,;:="), behind.size());
        if (known_unit(std::string(behind.substr(0, end)))) {
            const std::string without = std::string(name.substr(0, at)) + std::string(behind.substr(end));
            std::optional<NamedStatement> named = statement_named(without, false);
            // "U / V" and "Correction in µm" may be rows, as "U" and "Correction" may; "U / µg = 721 (k = 2)" is none.
            const bool may_be_row = named && (named->may_be_quantity || named->may_be_constant);
            const bool is_U = named && named->statement == Statement::U;
            if (named && (!may_be_row || (is_U && coverage_in(named->assigned).says_any()))) {
                return named;
            }
            // "U / mm" alone is no voltage: it is as much a statement as "U" beside a unit is.
            const auto is_voltage = [](const gum::Unit& unit) {
                return unit.dimension() == gum::Unit::parse("V").dimension();
            };
            if (is_U && !is_voltage(*known_unit(std::string(behind.substr(0, end)))) && named->assigned.empty()) {
                named->unit_of_U = behind.substr(0, end);
                return named;
            }
        }
    }
    if (const std::size_t sign = name.find_first_of("=:"); sign != std::string_view::npos) {
        const std::string_view behind = trimmed(name.substr(sign + 1));
        const std::string_view symbol = trimmed(name.substr(0, sign));
        // "U = k · u mit k = 2": what k is stands behind the product.
        std::size_t with = std::string_view::npos;
        for (const std::string_view word : {" mit ", " with ", ", ", "; ", " ("}) {
            const std::size_t at = behind.find(word);
            with = at != std::string_view::npos && begins_with_coverage(behind.substr(at)) ? std::min(with, at) : with;
        }
        const std::string_view product = behind.substr(0, with);
        if (const auto [factor, is_last] = factor_of_u(product.substr(0, product.find('='))); !factor.empty()) {
            const std::optional<NamedStatement> whole = whole_statement(symbol);
            if ((whole && whole->statement == Statement::U) || symbol.starts_with("U(") || symbol == "U_95") {
                const std::string said(with == std::string_view::npos ? std::string_view() : behind.substr(with));
                const bool is_symbol_of_k = factor.front() == 'k' || factor.front() == 't';
                const FactorInNumbers k =
                    is_symbol_of_k ? factor_in_numbers(product, is_last) : FactorInNumbers{.k = factor};
                // Where the product has k and nobody can tell which number it is, k is stated all the same.
                const std::string in_product(k.is_open && said.empty() ? trimmed(product) : std::string_view());
                return NamedStatement{.statement = Statement::U,
                                      .coverage = k.k.empty() ? said + in_product : "k = " + std::string(k.k) + said,
                                      .other_k = std::string(k.other),
                                      .assigned = std::string(number_at_end(product))};
            }
        }
        if (std::optional<NamedStatement> named = whole_statement(name.substr(0, sign))) {
            const bool is_of_coverage =  // "k = 2 (p = 95 %)" has its number
                named->statement == Statement::coverage_probability || named->statement == Statement::k;
            (begins_with_coverage(behind) && !is_of_coverage ? named->coverage : named->assigned) = behind;
            return named;
        }
    }
    // "Expanded uncertainty, k=2, 95 %" is a name and what is said of coverage.
    for (std::size_t at = name.find_first_of(" ,;("); at != std::string_view::npos;
         at = name.find_first_of(" ,;(", at + 1)) {
        if (!begins_with_coverage(name.substr(at))) {
            continue;
        }
        if (std::optional<NamedStatement> named = whole_statement(name.substr(0, at), name.substr(at))) {
            named->coverage = name.substr(at);
            named->may_be_quantity = false;
            return named;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<NamedStatement> named_statement(std::string_view name) {
    // "Model: y = m/V" in one cell. A model of an instrument has no sign of equality.
    if (const std::size_t colon = name.find(':'); colon != std::string_view::npos) {
        const std::string_view behind = trimmed(name.substr(colon + 1));
        const std::optional<NamedStatement> whole = statement_named(trimmed(name.substr(0, colon)), true);
        if (whole && whole->statement == Statement::equation && behind.find('=') != std::string_view::npos) {
            return NamedStatement{.statement = Statement::equation, .assigned = std::string(behind)};
        }
    }
    return statement_named(name, true);
}

std::optional<TypedHead> typed_head(std::string_view head) {
    constexpr std::size_t k_longest = 80;
    const std::string lower = text::in_small_letters(head);
    if (head.size() > k_longest || lower.size() != head.size()) {
        return std::nullopt;
    }
    for (const bool is_a : {true, false}) {
        for (const std::string_view word : {"(type ", "(typ ", "(tipo ", "type ", "typ ", "tipo ", "("}) {
            const bool in_brackets = word.starts_with('(');
            const std::string token = std::string(word) + (is_a ? "a" : "b") + (in_brackets ? ")" : "");
            const std::size_t at = lower.find(token), end = at + token.size();
            if (at == std::string::npos ||
                (!in_brackets && end < lower.size() && (is_letter(lower[end]) || lower[end] == '/'))) {
                continue;
            }
            const std::string rest = std::string(head.substr(0, at)) + std::string(head.substr(end));
            std::string_view name = trimmed(rest);
            std::string unit = unit_in_head(rest);
            if (!name.empty() && !meaning_of_head(name) && known_unit(std::string(name))) {  // "Type A (%)"
                unit = unit.empty() ? std::string(name) : unit;
                name = {};
            }
            const std::size_t blank = name.rfind(' ');
            const std::string last(name.substr(blank == std::string_view::npos ? 0 : blank + 1));
            if (unit.empty() && !meaning_of_head(last) && known_unit(last)) {
                unit = last;
                name = trimmed(name.substr(0, name.size() - last.size()));
            }
            name = trimmed(without_brackets(without_unit(name)));
            while (name.ends_with(',') || name.ends_with('-') || name.ends_with('/')) {
                name = trimmed(name.substr(0, name.size() - 1));
            }
            const std::optional<Column> column = name.empty() ? Column::u : column_of(name);
            if (column == Column::u || column == Column::contribution) {
                return TypedHead{.is_a = is_a, .column = *column, .unit = unit};
            }
        }
    }
    return std::nullopt;
}

SumName sum_name(std::string_view name) {
    constexpr std::size_t k_longest = 80;
    if (name.size() > k_longest) {
        return SumName::none;
    }
    const std::string lower = text::in_small_letters(name);
    for (const std::string_view part :
         {"subtotal", "sub-total", "sub total", "subsum", "intermediate sum", "partial sum", "partial total",
          "zwischensumme", "teilsumme", "zwischenergebnis", "suma parcial", "小計", "小计"}) {
        if (lower.find(part) != std::string::npos) {
            return SumName::part;
        }
    }
    bool has_sum = false, has_type = false, has_letter = false, has_others = false, has_squares = false,
         has_root = false, has_variance = false, has_square = false, is_of_type = false;
    std::string_view last;
    for (std::size_t at = 0; at < lower.size();) {
        const std::size_t end = std::min(lower.find_first_of(" :,;()/-", at), lower.size());
        const std::string_view word = std::string_view(lower).substr(at, end - at);
        at = end + 1;
        last = word.empty() ? last : word;
        if (is_one_of(word, {"sum", "summation", "summe", "suma", "total", "gesamt", "insgesamt", "combined",
                             "kombiniert", "rss", "intermediate", "合計", "合计"})) {
            has_sum = true;
        } else if (is_one_of(word, {"u_a", "u_b", "ua", "ub"})) {
            is_of_type = true;
        } else if (is_one_of(word, {"type", "typ", "tipo"})) {
            has_type = true;
        } else if (is_one_of(word, {"a", "b"})) {
            has_letter = true;
        } else if (is_one_of(word, {"squares", "quadrate", "cuadrados"})) {
            has_squares = true;
        } else if (word == "quadratsumme") {
            has_squares = has_sum = true;
        } else if (is_one_of(word, {"root", "wurzel", "raíz"})) {
            has_root = true;
        } else if (is_one_of(word, {"variance", "variances", "varianz", "varianzen"})) {
            has_variance = true;
        } else if (is_one_of(word, {"u²", "u_c²", "uc²", "u_c^2", "uc^2", "u^2"})) {
            has_square = true;
        } else if (!word.empty() && !is_one_of(word, {"uncertainty",
                                                      "uncertainties",
                                                      "unsicherheit",
                                                      "unsicherheiten",
                                                      "standardunsicherheit",
                                                      "messunsicherheit",
                                                      "incertidumbre",
                                                      "standard",
                                                      "contribution",
                                                      "contributions",
                                                      "component",
                                                      "components",
                                                      "beiträge",
                                                      "of",
                                                      "the",
                                                      "all",
                                                      "der",
                                                      "des",
                                                      "von",
                                                      "aller",
                                                      "de",
                                                      "evaluation",
                                                      "evaluations",
                                                      "result",
                                                      "kombinierte",
                                                      "u"})) {
            has_others = true;
        }
    }
    // "Variance of the standard" may be a contribution.
    const bool is_of_one = !has_sum && is_one_of(last, {"standard", "contribution", "component"});
    if (!has_others && !has_root && ((has_sum && has_squares) || has_square || (has_variance && !is_of_one))) {
        return SumName::of_squares;
    }
    if (has_others) {
        return has_sum ? SumName::of_quantity : SumName::none;
    }
    if (is_of_type || ((has_sum || has_type) && has_letter)) {
        return SumName::of_type;
    }
    return has_sum ? SumName::whole : SumName::none;
}

bool is_called_part(std::string_view name) {
    constexpr std::size_t k_longest = 20;  // bytes of the words that say so
    const std::string lower = text::in_small_letters(cut(trimmed(name), k_longest));
    constexpr std::string_view k_words[] = {"of which ",  "of which:", "thereof ",       "thereof:", "davon ",
                                            "davon:",     "darin ",    "darunter ",      "hiervon ", "incl. ",
                                            "including ", "de ello ",  "de los cuales ", "其中"};
    return std::any_of(std::begin(k_words), std::end(k_words),
                       [&lower](std::string_view word) { return lower.starts_with(word); });
}

bool are_u_and_U(std::string_view u_c, std::string_view U) {
    u_c = trimmed(u_c);
    U = trimmed(U);
    if (!u_c.starts_with('u') || !U.starts_with('U')) {
        return false;
    }
    const std::string_view of_u = u_c.substr(1);
    std::string_view of_U = U.substr(1);
    if (of_u.empty() || std::string_view("(_ ").find(of_u.front()) == std::string_view::npos ||
        !of_U.starts_with(of_u)) {
        return false;
    }
    of_U.remove_prefix(of_u.size());
    return trimmed(of_U).empty() || begins_with_coverage(of_U);
}

std::optional<Statement> statement_of(std::string_view name) {
    const std::optional<NamedStatement> named = named_statement(name);
    return named ? std::optional(named->statement) : std::nullopt;
}

std::string certificate_in(std::string_view text) {
    const std::string lower = text::in_small_letters(text);
    for (const std::string_view word : {"certificate", "cert.", "kalibrierschein", "zertifikat", "certificado"}) {
        const std::size_t at = lower.find(word);
        if (at == std::string::npos || lower.size() != text.size()) {
            continue;
        }
        const std::size_t number = text.find_first_not_of(" :#", at + word.size());
        if (number == std::string_view::npos) {
            continue;
        }
        const std::string_view rest = text.substr(number);
        const std::string_view named = trimmed(rest.substr(0, rest.find_first_of(";,()")));
        const std::string_view first = named.substr(0, named.find(' '));
        // What has no digit in its first words is no number: "certificate of the maker, 2024".
        constexpr std::size_t k_longest = 40;
        const bool is_number_word =
            first == "No" || first == "No." || first == "Nr" || first == "Nr." || first == "no.";
        if (named.size() <= k_longest &&
            (first.find_first_of("0123456789") != std::string_view::npos ||
             (is_number_word && named.find_first_of("0123456789") != std::string_view::npos))) {
            return std::string(word == "cert." ? "certificate" : text.substr(at, word.size())) + " " +
                   std::string(named);
        }
    }
    return "";
}

CoverageText coverage_in(std::string_view text) {
    text = cut(text, k_longest_text);
    CoverageText found;
    for (std::size_t at = 0; at < text.size() && found.k.empty(); ++at) {
        found.k = number_of_k(text, at);
    }
    for (std::size_t percent = text.find('%'); percent != std::string_view::npos && !found.p;
         percent = text.find('%', percent + 1)) {
        std::size_t end = percent;
        while (end > 0 && (text[end - 1] == ' ' || text[end - 1] == '\xA0' || text[end - 1] == '\xC2')) {
            --end;
        }
        std::size_t from = end;
        while (from > 0 && is_of_number(text[from - 1])) {
            --from;
        }
        const bool is_number_alone = from == 0 || !is_letter(text[from - 1]);
        const std::optional<StatedNumber> p =
            is_number_alone ? read_number(text.substr(from, end - from), "") : std::nullopt;
        if (p && p->value > 50.0 && p->value < 100.0) {
            found.p = p->value / 100.0;
        }
    }
    if (const std::size_t at = text.find("p =");
        !found.p && at != std::string_view::npos && (at == 0 || !is_letter(text[at - 1]))) {
        const std::optional<LeadingNumber> p = read_leading_number(text.substr(at + 3), "");
        if (p && p->number.value > 0.5 && p->number.value < 1.0) {
            found.p = p->number.value;
        }
    }
    return found;
}

std::optional<double> k_of_distribution(std::string_view text) {
    text = cut(text, k_longest_text);
    const CoverageText coverage = coverage_in(text);
    std::string_view k = coverage.k;
    for (const std::string_view sign : {"σ", "sigma", "Sigma"}) {
        std::size_t at = k.empty() ? text.find(sign) : std::string_view::npos;
        while (at != std::string_view::npos && at > 0 && text[at - 1] == ' ') {
            --at;
        }
        if (at != std::string_view::npos && at > 0 && text[at - 1] >= '1' && text[at - 1] <= '3' &&
            (at == 1 || !is_of_number(text[at - 2]))) {
            k = text.substr(at - 1);
        }
    }
    const std::optional<LeadingNumber> number = k.empty() ? std::nullopt : read_leading_number(k, "", Percent::unit);
    return number && number->number.value > 0.0 ? std::optional(number->number.value) : std::nullopt;
}

}  // namespace gumcert::audit
