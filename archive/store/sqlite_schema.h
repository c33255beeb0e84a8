#pragma once

namespace gumcert::archive {

/// "gcAr": which program a SQLite file belongs to (PRAGMA application_id).
inline constexpr int k_application_id = 0x67634172;
/// PRAGMA user_version.
inline constexpr int k_schema_version = 1;

/// Tables, indices and triggers of version 1. tools/verify_archive.py knows their digest: a change is a new version.
/// The trigger before INSERT stops REPLACE, too, which else removes a row without asking the trigger of DELETE.
inline constexpr const char* k_schema = R"sql(
CREATE TABLE content(
 sha256 TEXT PRIMARY KEY NOT NULL CHECK(length(sha256) = 64),
 bytes BLOB NOT NULL
) STRICT;
CREATE TABLE log(
 seq INTEGER PRIMARY KEY NOT NULL CHECK(seq > 0),
 at TEXT NOT NULL,
 actor TEXT NOT NULL,
 kind TEXT NOT NULL,
 certificate TEXT NOT NULL,
 record TEXT REFERENCES content(sha256),
 request_key TEXT NOT NULL,
 body TEXT NOT NULL,
 prev BLOB NOT NULL CHECK(length(prev) = 32),
 hash BLOB NOT NULL CHECK(length(hash) = 32)
) STRICT;
CREATE TABLE listed(
 certificate TEXT PRIMARY KEY NOT NULL,
 state TEXT NOT NULL,
 since TEXT NOT NULL,
 item TEXT NOT NULL,
 record TEXT NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX log_by_certificate ON log(certificate, kind, seq);
CREATE INDEX log_by_kind ON log(kind, seq);
CREATE UNIQUE INDEX log_by_request ON log(request_key) WHERE request_key <> '';
CREATE TRIGGER log_is_not_updated BEFORE UPDATE ON log
BEGIN SELECT RAISE(ABORT, 'an entry of the log is not changed'); END;
CREATE TRIGGER log_is_not_deleted BEFORE DELETE ON log
BEGIN SELECT RAISE(ABORT, 'an entry of the log is not removed'); END;
CREATE TRIGGER log_grows_at_its_end BEFORE INSERT ON log
WHEN NEW.seq <> (SELECT ifnull(max(seq), 0) + 1 FROM log)
 OR NEW.prev <> ifnull((SELECT hash FROM log WHERE seq = NEW.seq - 1), zeroblob(32))
 OR (NEW.request_key <> '' AND EXISTS(SELECT 1 FROM log WHERE request_key = NEW.request_key))
BEGIN SELECT RAISE(ABORT, 'an entry of the log follows the last one'); END;
CREATE TRIGGER content_is_not_updated BEFORE UPDATE ON content
BEGIN SELECT RAISE(ABORT, 'a content is not changed'); END;
CREATE TRIGGER content_is_not_deleted BEFORE DELETE ON content
BEGIN SELECT RAISE(ABORT, 'a content is not removed'); END;
CREATE TRIGGER content_is_not_replaced BEFORE INSERT ON content
WHEN EXISTS(SELECT 1 FROM content WHERE sha256 = NEW.sha256)
BEGIN SELECT RAISE(ABORT, 'a content is kept once'); END;
)sql";

}  // namespace gumcert::archive
