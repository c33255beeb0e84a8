#include "reports/dcc/dcc_schema_facts.h"

namespace gumcert::reports {

std::string_view dcc_schema_facts() {
    return R"(
certificate [schemaVersion!] = administrativeData:administrative measurementResults:measurementResults
    comment:anything? document:bytes? ds:Signature*@320
administrative = dccSoftware:softwares & refTypeDefinitions:refTypeDefinitions?@320 & coreData:core & items:items &
    calibrationLaboratory:laboratory & respPersons:persons & customer:contact & statements:statements?
softwares = software:software+
software [id refId@330 refType] = name:text release:word type:softwareKind? description:rich?
softwareKind ~ application bios driver editor firmware library os other
refTypeDefinitions = refTypeDefinition:refTypeDefinition+
refTypeDefinition [refType] = name:text description:rich? namespace:word link:word@-329 link:uri@330 release:word?
    value:word? procedure:word?
core = countryCodeISO3166_1:country usedLangCodeISO639_1:language+ mandatoryLangCodeISO639_1:language+
    uniqueIdentifier:word identifications:identifications? receiptDate:date? beginPerformanceDate:date
    endPerformanceDate:date performanceLocation:place issueDate:date?@320 reportAmendedSubstituted:replaced?@320
    previousReport:hash?
place [id refId refType] ~ laboratory customer laboratoryBranch customerBranch other
replaced [id refId@330 refType] = typeOfChange:change replacedUniqueIdentifier:word
change ~ amended substituted
items [id@330 refId@330] = name:text? equipmentClass:class?@-319 equipmentClass:class*@320 description:rich?
    owner:contact? manufacturer:contactOrName?@320 identifications:identifications? item:item+
item [id refId@330 refType@320] = name:text equipmentClass:class?@-319 equipmentClass:class*@320 description:rich?
    owner:contact?@330 installedSoftwares:softwares? manufacturer:contactOrName@-319 manufacturer:contactOrName?@320
    model:word? identifications:identifications itemQuantities:itemQuantities?@320 subItems:items?@330
itemQuantities = itemQuantity:plainQuantity+
class [id refId@330 refType@320] = reference:word classID:word link:uri?@330
identifications = identification:identification+
identification [id refId@330 refType] = issuer:issuer value:word name:text?
issuer ~ manufacturer calibrationLaboratory customer owner other
laboratory = calibrationLaboratoryCode:word? contact:contact cryptElectronicSeal:boolean?@320
    cryptElectronicSignature:boolean?@320 cryptElectronicTimeStamp:boolean?@320
persons = respPerson:person+
person [id refId@330 refType@320] = person:contactOrName description:rich? role:word? mainSigner:boolean?
    cryptElectronicSeal:boolean? cryptElectronicSignature:boolean? cryptElectronicTimeStamp:boolean?
contact [id refId@330 refType@330] = name:text eMail:word@-319 eMail:word?@320 phone:word? fax:word? link:uri?@330
    location:location descriptionData:bytes?
contactOrName [id refId refType] = name:text eMail:word? phone:word? fax:word? link:uri?@330 location:location?
    descriptionData:bytes?
location = (city:word | countryCode:country | postCode:word | postOfficeBox:word | state:word | street:word |
    streetNo:word | further:rich | positionCoordinates:coordinates)+
coordinates [id refId refType] = positionCoordinateSystem:word reference:word? declaration:rich?
    positionCoordinate1:si.real positionCoordinate2:si.real positionCoordinate3:si.real? link:uri?@330
statements = statement:statement+
statement [id refId refType] = name:text?@320 description:rich?@320 countryCodeISO3166_1:country* convention:word?
    traceable:boolean? norm:word* reference:word* link:uri*@330 declaration:rich? (valid:boolean |
    validXMLList:boolean[]@320)? date:date? period:duration? respAuthority:contact? (conformity:conformity |
    conformityXMLList:conformity[])? data:data? nonSIDefinition:word? nonSIUnit:word? location:location?@312
conformity ~ pass fail conditionalPass conditionalFail noPass noFail
hash [id refId@330 refType@320] = referral:text referralID:word procedure:word value:word description:rich?@320
    inValidityRange:boolean?@320 traceable:boolean?@320 linkedReport:hash?
measurementResults = (usedMethods:methods? usedSoftware:softwares? measuringEquipments:equipments?
    influenceConditions:conditions? measurementMetaData:metaData?)@330 measurementResult:measurementResult+
measurementResult [id refId refType] = name:text description:rich? usedMethods:methods? usedSoftware:softwares?
    measuringEquipments:equipments? influenceConditions:conditions? results:results measurementMetaData:metaData?
methods = usedMethod:method+
method [id refId@330 refType] = name:text description:rich? norm:word* reference:word* link:uri*@330
    usedMethodQuantities:methodQuantities?@330
methodQuantities = usedMethodQuantity:plainQuantity+
equipments = name:text? equipmentClass:class?@-319 equipmentClass:class*@320 description:rich? owner:contact?
    identifications:identifications? measuringEquipment:equipment+
equipment [id refId@330 refType] = name:text equipmentClass:class?@-319 equipmentClass:class*@320 description:rich?
    certificate:hash? manufacturer:contactOrName? model:word? identifications:identifications?
    measuringEquipmentQuantities:equipmentQuantities? installedSoftware:softwares?@330
equipmentQuantities = measuringEquipmentQuantity:plainQuantity+
conditions = influenceCondition:condition+
condition [id refId@330 refType] = name:text description:rich? status:state? certificate:hash? data:data
state ~ beforeAdjustment afterAdjustment beforeRepair afterRepair
results = result:result+
result [id refId refType] = name:text description:rich? data:data
data [id refId refType] = (text:rich | formula:formula | byteData:bytes | xml:foreign | quantity:quantity |
    list:list)+
list [id refId refType] = name:text? description:rich? (dateTime:dateTime? | dateTimeXMLList:dateTime[]?)
    ((list:list+ | quantity:quantity+)@-319 | (list:list | quantity:quantity)+@320) usedMethods:methods?
    usedSoftware:softwares? measuringEquipments:equipments? influenceConditions:conditions?
    measurementMetaData:metaData?
metaData = metaData:statement+
quantity [id refId refType] = name:text? description:rich? (noQuantity:rich | charsXMLList:string[]@320 | si:real |
    si:list | si:hybrid | si:complex | si:constant | si:realListXMLList | si:complexListXMLList@330)
    relativeUncertainty:relativeUncertainty? usedMethods:methods? usedSoftware:softwares?
    measuringEquipments:equipments? influenceConditions:conditions? measurementMetaData:metaData?
plainQuantity [id refId refType] = name:text? description:rich? (noQuantity:rich | charsXMLList:string[]@320 |
    si:real | si:hybrid | si:complex | si:constant | si:realListXMLList | si:complexListXMLList@330)
relativeUncertainty = relativeUncertaintyXmlList:si.realListXMLList | relativeUncertaintySingle:si.real
text [id refId@330] = content:translation+
translation [lang id refId refType] ~
rich [id refId refType] = name:text? (content:translation* file:bytes* formula:formula*)+
bytes [id refId@320 refType@320] = name:text? description:rich? fileName:word mimeType:word dataBase64:base64
formula [id refId refType] = latex:string | mathml:foreign
si.real = label:string? si:quantityTypeQUDT?@330 value:decimal unit:string significantDigit:integer?@330
    dateTime:dateTime? (measurementUncertaintyUnivariate:si.univariate@330 | expandedUnc:si.expandedUnc |
    coverageInterval:si.coverageInterval)?
si.univariate = standardMU:si.standardMU | expandedMU:si.expandedMU | coverageIntervalMU:si.coverageIntervalMU
si.standardMU = valueStandardMU:positive distribution:string?
si.expandedMU = valueExpandedMU:positive coverageFactor:factor coverageProbability:probability distribution:string?
si.coverageIntervalMU = valueStandardMU:positive intervalMin:decimal intervalMax:decimal
    coverageProbability:probability distribution:string?
si.expandedUnc = uncertainty:positive coverageFactor:factor coverageProbability:probability distribution:string?
si.coverageInterval = standardUnc:positive intervalMin:decimal intervalMax:decimal coverageProbability:probability
    distribution:string?
si.constant = label:string? si:quantityTypeQUDT?@330 value:decimal unit:string significantDigit:integer?@330
    dateTime:dateTime? valueStandardMU:positive?@330 uncertainty:positive? distribution:string?
si.complex = label:string? si:quantityTypeQUDT?@330 (valueReal:decimal valueImag:decimal unit:string |
    valueMagnitude:decimal valuePhase:decimal unit:string unitPhase:string) dateTime:dateTime? (si:ellipsoidalRegion
    | si:rectangularRegion)?
si.ellipsoidalRegion = covarianceMatrix:si.covarianceMatrix coverageFactor:factor coverageProbability:probability
    distribution:string?
si.rectangularRegion = covarianceMatrix:si.covarianceMatrix coverageFactor:factor coverageProbability:probability
    distribution:string?
si.covarianceMatrix = column:si.column+
si.column = covariance:si.covariance+
si.covariance = value:decimal unit:string
si.list = label:string? dateTime:dateTime? (si:realList | si:realListXMLList@330 | si:complexList |
    si:complexListXMLList@330 | si:list)+
si.realList = label:string? dateTime:dateTime? si:listQuantityTypeQUDT?@330 listUnit:string?
    listsignificantDigit:integer?@330 listMeasurementUncertaintyUnivariate:si.univariateOfAll?@330
    listUnivariateUnc:si.oldUnivariateOfAll? real:si.realInList+ (si:ellipsoidalRegion | si:rectangularRegion)?
si.univariateOfAll = standardMU:si.standardMU | expandedMU:si.expandedMU | coverageIntervalMU:si.coverageInterval |
    expandedUnc:si.expandedUnc | coverageInterval:si.coverageInterval
si.oldUnivariateOfAll = expandedUnc:si.expandedUnc | coverageInterval:si.coverageInterval
si.realInList = label:string? si:quantityTypeQUDT?@330 value:decimal unit:string? significantDigit:integer?@330
    dateTime:dateTime? (measurementUncertaintyUnivaraite:si.univariate@330 | expandedUnc:si.expandedUnc |
    coverageInterval:si.coverageInterval)?
si.complexList = label:string? dateTime:dateTime? si:listQuantityTypeQUDT?@330 listUnit:string?
    listUnitPhase:string? listBivariateUnc:si.bivariateOfAll? complex:si.complexInList+ (si:ellipsoidalRegion |
    si:rectangularRegion)?
si.bivariateOfAll = (si:ellipsoidalRegion | si:rectangularRegion)?
si.complexInList = label:string? si:quantityTypeQUDT?@330 (valueReal:decimal valueImag:decimal unit:string? |
    valueMagnitude:decimal valuePhase:decimal unit:string? unitPhase:string?) dateTime:dateTime?
    (si:ellipsoidalRegion | si:rectangularRegion)?
si.realListXMLList = labelXMLList:string[]? si:quantityTypeQUDTXMLList?@330 valueXMLList:decimal[]
    unitXMLList:string[] significantDigitXMLList:integer[]?@330 dateTimeXMLList:dateTime[]?
    (measurementUncertaintyUnivariateXMLList:si.univariateList@330 | expandedUncXMLList:si.expandedUncList |
    coverageIntervalXMLList:si.coverageIntervalList)?
    (measurementUncertaintyMultivariateXMLList:si.multivariateList@330 |
    ellipsoidalRegionXMLList:si.ellipsoidalRegion | rectangularRegionXMLList:si.rectangularRegion)?
si.univariateList = standardMUXMLList:si.standardMUList | expandedMUXMLList:si.expandedMUList |
    coverageIntervalMUXMLList:si.coverageIntervalMUList
si.standardMUList = valueStandardMUXMLList:positive[] distributionXMLList:string[]?
si.expandedMUList = valueExpandedMUXMLList:positive[] coverageFactorXMLList:factor[]
    coverageProbabilityXMLList:probability[] distributionXMLList:string[]?
si.coverageIntervalMUList = valueStandardMUXMLList:positive[] intervalMinXMLList:decimal[]
    intervalMaxXMLList:decimal[] coverageProbabilityXMLList:probability[] distributionXMLList:string[]?
si.expandedUncList = uncertaintyXMLList:positive[] coverageFactorXMLList:factor[]
    coverageProbabilityXMLList:probability[] distributionXMLList:string[]?
si.coverageIntervalList = standardUncXMLList:positive[] intervalMinXMLList:decimal[] intervalMaxXMLList:decimal[]
    coverageProbabilityXMLList:probability[] distributionXMLList:string[]?
si.multivariateList = (ellipsoidalRegionMUXMLList:si.regionList | rectangularRegionMUXMLList:si.regionList)?
si.regionList = covarianceMatrixXMLList:si.covarianceMatrixList coverageFactorXMLList:factor[]
    coverageProbabilityXMLList:probability[] distributionXMLList:string[]?
si.covarianceMatrixList = columnXMLList:si.columnList+
si.columnList = covarianceXMLList:si.covarianceList+
si.covarianceList = valueXMLList:decimal[] unitXMLList:string[]
si.complexListXMLList = labelXMLList:string[]? si:quantityTypeQUDTXMLList?@330 (valueRealXMLList:decimal[]
    valueImagXMLList:decimal[] unitXMLList:string[] | valueMagnitudeXMLList:decimal[] valuePhaseXMLList:decimal[]
    unitXMLList:string[] unitPhaseXMLList:string[]) dateTimeXMLList:dateTime[]?
    measurementUncertaintyBivariateXMLList:si.multivariateList?
    measurementUncertaintyMultivariateXMLList:si.multivariateList?
si.hybrid = real:si.real+ | complex:si.complex+ | list:si.list+ | realList:si.realList+ |
    realListXMLList:si.realListXMLList+ | complexList:si.complexList+ |
    complexListXMLList:si.complexListXMLList+@330 | constant:si.constant+
si.quantityTypeQUDT ~
si.listQuantityTypeQUDT ~
si.quantityTypeQUDTXMLList ~
)";
}

}  // namespace gumcert::reports
