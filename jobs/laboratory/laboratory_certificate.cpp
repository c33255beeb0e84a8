#include "jobs/laboratory/laboratory_certificate.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "jobs/laboratory/json_members.h"
#include "jobs/laboratory/laboratory_codes.h"
#include "jobs/laboratory/registered_differences.h"
#include "jobs/laboratory/standard_row.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

using laboratory::StandardRecord;
using nlohmann::json;

void LaboratoryCertificate::complete(JsonDocument& document, const CertificatePlace& place) {
    json& data = document.value.at(json::json_pointer(place.pointer));
    if (!data.is_object() || refuse_without_folder(data, place)) {
        return;
    }
    if (const LaboratoryFile* file = folder().laboratory()) {
        if (file->laboratory.is_object()) {
            json registered = file->laboratory;
            name_in_folder(registered, "logo");
            complete_object(data, "laboratory", registered, "the laboratory", "");
        }
        if (file->accreditation.is_object() && text_in(data, "status") != "not_accredited") {
            complete_accreditation(data, *file);
        }
        complete_persons(data, *file, place);
        for (const SignatoryStatement& person : file->signatories) {
            use_.facts().signatories.push_back(
                {person.name, person.from, person.to, person.methods, person.authorises});
        }
    } else if (data.contains("persons") && data["persons"].is_object()) {
        for (auto& [role, person] : data["persons"].items()) {
            if (person.is_string()) {
                discard(person);  // whom it means stands in the file that was refused
            }
        }
    }
    complete_by_id(data, "customer", place, "", true);
    complete_by_id(data, "method", place, "", false);
    if (const auto sections = data.find("sections"); sections != data.end() && sections->is_array()) {
        for (std::size_t i = 0; i < sections->size(); ++i) {
            if ((*sections)[i].is_object()) {
                complete_by_id((*sections)[i], "method", place, child_pointer("/sections", i), false);
            }
        }
    }
    complete_standards(data, place);
}

/// \return whether there is no folder; what refers to one is refused then
bool LaboratoryCertificate::refuse_without_folder(json& data, const CertificatePlace& place) {
    if (use_.folder() != nullptr) {
        return false;
    }
    const auto refuse = [&](json& value, const std::string& relative, const std::string& example) {
        if (value.is_string() || (value.is_object() && value.contains("id"))) {
            place.below(relative).refuse(
                k_laboratory_missing, described(value) + ", and no laboratory",
                "what is not written out stands in the files of the laboratory",
                "add \"laboratory\": \"FOLDER\" to the job, or use --laboratory FOLDER; without such a "
                "folder write it out" +
                    example);
            discard(value);
        }
    };
    for (const char* key : {"customer", "method"}) {
        if (data.contains(key)) {
            refuse(data[key], std::string("/") + key, "");
        }
    }
    if (data.contains("sections") && data["sections"].is_array()) {
        for (std::size_t i = 0; i < data["sections"].size(); ++i) {
            if (json& section = data["sections"][i]; section.is_object() && section.contains("method")) {
                refuse(section["method"], child_pointer("/sections", i) + "/method", "");
            }
        }
    }
    if (data.contains("persons") && data["persons"].is_object()) {
        for (auto& [key, person] : data["persons"].items()) {
            refuse(person, child_pointer("/persons", key), R"(, such as {"name": "A. Feld"})");
        }
    }
    if (data.contains("standards") && data["standards"].is_array()) {
        for (std::size_t i = 0; i < data["standards"].size(); ++i) {
            refuse(data["standards"][i], child_pointer("/standards", i), "");
        }
    }
    return true;
}

/// Fills in what an object of the data does not state, and notes what it states otherwise.
void LaboratoryCertificate::complete_object(json& data, const std::string& key, const json& registered,
                                            const std::string& subject, const std::string& pointer) {
    json& object = data[key];
    if (object.is_null()) {
        object = json::object();
    }
    if (!object.is_object()) {
        return;  // its reader refuses it
    }
    for (const auto& [name, value] : registered.items()) {
        const auto stated = object.find(name);
        if (stated == object.end()) {
            object[name] = value;
        } else if (*stated != value && !stated->is_discarded()) {
            note_differences(*stated, value, subject, pointer + "/" + key + "/" + name, use_.facts().contradictions);
        }
    }
}

void LaboratoryCertificate::complete_by_id(json& data, const char* key, const CertificatePlace& place,
                                           const std::string& below, bool is_customer) {
    const auto found = data.find(key);
    if (found == data.end()) {
        return;
    }
    const bool is_reference = found->is_object() && found->contains("id");
    if (!found->is_string() && !is_reference) {
        return;
    }
    json& value = *found;
    const CertificatePlace at = place.below(below + "/" + key + (is_reference ? "/id" : ""));
    const json id = is_reference ? value["id"] : value;
    if (!id.is_string() || !LaboratoryFolder::is_identification(id.get_ref<const std::string&>())) {
        at.refuse(k_laboratory_id, described(id),
                  "an identification is the name of a file: letters, digits, '-', '_' and '.'",
                  "name it as its file is named, without .json");
        discard(value);
        return;
    }
    const bool is_absent = use_.refuse_absent(is_customer ? "customers" : "methods", id.get<std::string>(), at);
    const json* registered = is_absent     ? nullptr
                             : is_customer ? folder().customer(id.get<std::string>())
                                           : folder().method(id.get<std::string>());
    if (registered == nullptr) {
        discard(value);
        return;
    }
    if (!is_reference) {
        value = *registered;
        return;
    }
    value.erase("id");
    json other = *registered;
    if (is_customer) {  // contact and order are those of this work
        other.update(value);
        value = std::move(other);
        return;
    }
    if (value.contains("deviations") || value.contains("no_deviations")) {
        other.erase("deviations");
        other.erase("no_deviations");
    }
    complete_object(data, key, other, std::string("the ") + key, below);
}

/// Names of files are relative to the folder there, and to the job here.
void LaboratoryCertificate::name_in_folder(json& object, const char* key) const {
    if (const std::string file = text_in(object, key); !file.empty()) {
        object[key] = folder().name_of(file);
    }
}

void LaboratoryCertificate::complete_accreditation(json& data, const LaboratoryFile& file) {
    json registered = file.accreditation;
    name_in_folder(registered, "symbol_file");
    if (!registered.contains("signatories")) {
        json names = json::array();
        for (const SignatoryStatement& person : file.signatories) {
            if (person.authorises) {
                names.push_back(person.name);
            }
        }
        if (!names.empty()) {
            registered["signatories"] = std::move(names);
        }
    }
    complete_object(data, "accreditation", registered, "the accreditation", "");
}

void LaboratoryCertificate::complete_persons(json& data, const LaboratoryFile& file, const CertificatePlace& place) {
    if (!data.contains("persons") || !data["persons"].is_object()) {
        return;
    }
    for (auto& [role, person] : data["persons"].items()) {
        if (!person.is_string()) {
            continue;
        }
        const auto found = std::find_if(file.signatories.begin(), file.signatories.end(),
                                        [&person = person](const SignatoryStatement& one) { return one.id == person; });
        if (found == file.signatories.end()) {
            std::vector<std::string> known;
            for (const SignatoryStatement& one : file.signatories) {
                known.push_back(text::in_quotes(one.id));
            }
            place.below(child_pointer("/persons", role))
                .refuse(k_laboratory_person, described(person), "laboratory.json names " + text::listed(known, 20),
                        "name one of them, or write the person out");
            discard(person);
            continue;
        }
        json written{{"name", found->name}};
        set_if_stated(written, "function", found->function);
        set_if_stated(written, "authorised_from", found->from);
        set_if_stated(written, "authorised_to", found->to);
        person = std::move(written);
    }
}

void LaboratoryCertificate::complete_standards(json& data, const CertificatePlace& place) {
    const std::string day = use_.day_of_work();
    const bool is_listed = data.contains("standards");
    json& list = data["standards"];
    if (!is_listed) {
        list = json::array();
    }
    if (!list.is_array()) {
        return;  // its reader refuses it
    }
    std::vector<std::string> named;
    for (std::size_t i = 0; i < list.size(); ++i) {
        json& entry = list[i];
        const std::string pointer = child_pointer("/standards", i);
        if (entry.is_string()) {
            entry = json{{"identification", entry}};
        }
        const std::string id = entry.is_object() ? text_in(entry, "identification") : "";
        if (id.empty()) {
            continue;
        }
        named.push_back(id);
        const StandardRecord* record = LaboratoryFolder::is_identification(id) ? folder().standard(id, false) : nullptr;
        if (record == nullptr) {
            use_.facts().not_registered.push_back(id);
            if (!entry.contains("name")) {
                const bool is_told = LaboratoryFolder::is_identification(id) &&
                                     use_.refuse_absent("standards", id, place.below(pointer));
                if (!is_told) {
                    place.below(pointer).refuse(
                        k_laboratory_id, text::in_quotes(id) + " is not in the register",
                        "a standard that is named only stands in standards/" + text::visible(id) + ".json",
                        "add it to the register, or write the standard out");
                }
                discard(entry);
            }
            continue;
        }
        use_.note_day(*record, day);
        const json row = standard_row(*record, day, use_.lines_of(id));
        note_contradictions(entry, row, *record, pointer, use_.facts().contradictions);
        const bool states_U = entry.contains("U");  // and whether it is that of several lines
        for (const auto& [key, value] : row.items()) {
            if (!entry.contains(key) && !((key == "U_to" || key == "further") && states_U)) {
                entry[key] = value;
            }
        }
    }
    for (const std::string& id : use_.used()) {
        if (std::find(named.begin(), named.end(), id) == named.end()) {
            if (is_listed) {
                use_.facts().not_listed.push_back(id);
            }
            list.push_back(standard_row(*folder().standard(id), day, use_.lines_of(id)));
        }
    }
}

}  // namespace gumcert::jobs
