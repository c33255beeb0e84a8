#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/certificate/certificate_statement.h"
#include "jobs/laboratory/laboratory_folder.h"
#include "jobs/laboratory/laboratory_use.h"

namespace gumcert::jobs {

/// Certificate data with what the folder of the laboratory knows: what is missing in them is filled in, and what contradicts
/// the register is noted for the gates.
class LaboratoryCertificate final : public CertificateCompletion {
public:
    /// \param use  of the job, its inputs and points read; receives what the gates hold against the certificate. Must
    ///             outlive this
    explicit LaboratoryCertificate(LaboratoryUse& use) : use_(use) {}

    void complete(JsonDocument& document, const CertificatePlace& place) override;

private:
    using Json = nlohmann::json;

    [[nodiscard]] LaboratoryFolder& folder() const { return *use_.folder(); }
    [[nodiscard]] bool refuse_without_folder(Json& data, const CertificatePlace& place);
    void complete_object(Json& data, const std::string& key, const Json& registered, const std::string& subject,
                         const std::string& pointer);
    /// \param below  pointer of the object that has the key, within the certificate data
    void complete_by_id(Json& data, const char* key, const CertificatePlace& place, const std::string& below,
                        bool is_customer);
    void name_in_folder(Json& object, const char* key) const;
    void complete_accreditation(Json& data, const LaboratoryFile& file);
    void complete_persons(Json& data, const LaboratoryFile& file, const CertificatePlace& place);
    void complete_standards(Json& data, const CertificatePlace& place);

    LaboratoryUse& use_;
};

}  // namespace gumcert::jobs
