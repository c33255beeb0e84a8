#pragma once

namespace gumcert::archive {

/// What the schema is called in its database, and the comment by which it is known.
inline constexpr const char* k_postgresql_mark = "archive of gumcert, version 1";

/// Tables, indices, functions and triggers of version 1; the same as those of SQLite (archive/store/sqlite_schema.h). A
/// change is a new version.
inline constexpr const char* k_postgresql_schema = R"sql(
CREATE TABLE gumcert_archive.content(
 sha256 text COLLATE "C" PRIMARY KEY CHECK(length(sha256) = 64),
 bytes bytea NOT NULL
);
CREATE TABLE gumcert_archive.log(
 seq bigint PRIMARY KEY CHECK(seq > 0),
 at text COLLATE "C" NOT NULL,
 actor text COLLATE "C" NOT NULL,
 kind text COLLATE "C" NOT NULL,
 certificate text COLLATE "C" NOT NULL,
 record text COLLATE "C" REFERENCES gumcert_archive.content(sha256),
 request_key text COLLATE "C" NOT NULL,
 body text COLLATE "C" NOT NULL,
 prev bytea NOT NULL CHECK(length(prev) = 32),
 hash bytea NOT NULL CHECK(length(hash) = 32)
);
CREATE TABLE gumcert_archive.listed(
 certificate text COLLATE "C" PRIMARY KEY,
 state text COLLATE "C" NOT NULL,
 since text COLLATE "C" NOT NULL,
 item text COLLATE "C" NOT NULL,
 record text COLLATE "C" NOT NULL
);
CREATE INDEX log_by_certificate ON gumcert_archive.log(certificate, kind, seq);
CREATE INDEX log_by_kind ON gumcert_archive.log(kind, seq);
CREATE UNIQUE INDEX log_by_request ON gumcert_archive.log(request_key) WHERE request_key <> '';
CREATE FUNCTION gumcert_archive.refuse_change() RETURNS trigger LANGUAGE plpgsql AS $function$
BEGIN
 RAISE EXCEPTION 'an entry of the log and a content are neither changed nor removed' USING ERRCODE = '23000';
END
$function$;
CREATE FUNCTION gumcert_archive.refuse_other_place() RETURNS trigger LANGUAGE plpgsql AS $function$
DECLARE last record;
BEGIN
 SELECT seq, hash INTO last FROM gumcert_archive.log ORDER BY seq DESC LIMIT 1;
 IF NEW.seq <> coalesce(last.seq, 0) + 1 OR NEW.prev <> coalesce(last.hash, decode(repeat('00', 32), 'hex')) THEN
  RAISE EXCEPTION 'an entry of the log follows the last one' USING ERRCODE = '23000';
 END IF;
 RETURN NEW;
END
$function$;
CREATE TRIGGER log_is_not_changed BEFORE UPDATE OR DELETE OR TRUNCATE ON gumcert_archive.log
 FOR EACH STATEMENT EXECUTE FUNCTION gumcert_archive.refuse_change();
CREATE TRIGGER content_is_not_changed BEFORE UPDATE OR DELETE OR TRUNCATE ON gumcert_archive.content
 FOR EACH STATEMENT EXECUTE FUNCTION gumcert_archive.refuse_change();
CREATE TRIGGER log_grows_at_its_end BEFORE INSERT ON gumcert_archive.log
 FOR EACH ROW EXECUTE FUNCTION gumcert_archive.refuse_other_place();
)sql";

/// Everything that the schema has, one line each: "kind TAB name TAB what", sorted by bytes. Of the catalogue itself,
/// not of texts that the server makes: those differ from version to version.
inline constexpr const char* k_postgresql_description = R"sql(
WITH own AS (SELECT oid FROM pg_catalog.pg_namespace WHERE nspname = 'gumcert_archive')
SELECT line COLLATE "C" FROM (
 SELECT 'relation' || E'\t' || c.relname || E'\t' || pg_catalog.concat(c.relkind, c.relpersistence, c.relrowsecurity, c.relhasrules)
  FROM pg_catalog.pg_class c WHERE c.relnamespace = (SELECT oid FROM own) AND c.relkind <> 't'
 UNION ALL
 SELECT 'column' || E'\t' || c.relname || '.' || a.attname || E'\t' || pg_catalog.concat(t.typname, ' ', a.attnotnull, ' ',
   a.atthasdef, ' ', l.collname)
  FROM pg_catalog.pg_attribute a JOIN pg_catalog.pg_class c ON c.oid = a.attrelid
  JOIN pg_catalog.pg_type t ON t.oid = a.atttypid LEFT JOIN pg_catalog.pg_collation l ON l.oid = a.attcollation
  WHERE c.relnamespace = (SELECT oid FROM own) AND c.relkind = 'r' AND a.attnum > 0 AND NOT a.attisdropped
 UNION ALL
 SELECT 'constraint' || E'\t' || n.conname || E'\t' || pg_catalog.concat(n.contype, n.convalidated, ' ', n.conkey)
  FROM pg_catalog.pg_constraint n WHERE n.connamespace = (SELECT oid FROM own) AND n.contype IN ('p', 'f', 'c', 'u')
 UNION ALL
 SELECT 'index' || E'\t' || c.relname || E'\t' || pg_catalog.concat(i.indisunique, i.indisvalid, ' ', i.indkey, ' ',
   i.indpred IS NOT NULL)
  FROM pg_catalog.pg_index i JOIN pg_catalog.pg_class c ON c.oid = i.indexrelid
  WHERE c.relnamespace = (SELECT oid FROM own)
 UNION ALL
 SELECT 'trigger' || E'\t' || g.tgname || E'\t' || pg_catalog.concat(c.relname, ' ', p.proname, ' ', g.tgtype, ' ', g.tgenabled)
  FROM pg_catalog.pg_trigger g JOIN pg_catalog.pg_class c ON c.oid = g.tgrelid
  JOIN pg_catalog.pg_proc p ON p.oid = g.tgfoid
  WHERE c.relnamespace = (SELECT oid FROM own) AND NOT g.tgisinternal
 UNION ALL
 SELECT 'internal trigger' || E'\t' || c.relname || E'\t' || pg_catalog.concat(p.proname, ' ', g.tgenabled)
  FROM pg_catalog.pg_trigger g JOIN pg_catalog.pg_class c ON c.oid = g.tgrelid
  JOIN pg_catalog.pg_proc p ON p.oid = g.tgfoid
  WHERE c.relnamespace = (SELECT oid FROM own) AND g.tgisinternal
 UNION ALL
 SELECT 'function' || E'\t' || p.proname || E'\t' || pg_catalog.concat(p.prosrc, ' ', p.prosecdef)
  FROM pg_catalog.pg_proc p WHERE p.pronamespace = (SELECT oid FROM own)
) AS everything(line) ORDER BY 1
)sql";

}  // namespace gumcert::archive
