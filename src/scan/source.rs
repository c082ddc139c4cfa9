//! The bytes of a file or a stream: never more than a limit, and unpacked where they are gzip.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use flate2::bufread::GzDecoder;

use super::ReadError;

/// The most bytes that [`read_scan`](super::read_scan) takes, packed or unpacked: some 20 million facets of a
/// binary STL.
pub const MAX_BYTES: u64 = 1_000_000_000;

/// How gzip begins: its magic number and its only method.
const GZIP: &[u8] = b"\x1f\x8b\x08";

/// Reads a file of at most `limit` bytes. What is packed with gzip is unpacked, to at most `limit` bytes too.
///
/// # Errors
///
/// [`ReadError::Io`] where the file cannot be read, [`ReadError::TooLarge`] where it goes on beyond the limit, as
/// devices and archives made to do harm do, [`ReadError::Packed`] where it cannot be unpacked,
/// [`ReadError::PackedTwice`] where that leaves gzip again.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let io = |source| ReadError::Io {
        path: path.into(),
        source,
    };
    let file = File::open(path).map_err(io)?;
    let length = file.metadata().map_err(io)?.len();
    if length > limit {
        let path = path.into();
        return Err(ReadError::TooLarge { path, limit });
    }
    read_stream(file, path, limit)
}

/// Reads a stream, such as standard input, as [`read_bytes`] reads a file; `name` is what errors call it.
///
/// # Errors
///
/// Those of [`read_bytes`].
pub fn read_stream(stream: impl Read, name: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let path = || name.into();
    let too_large = || ReadError::TooLarge {
        path: path(),
        limit,
    };
    let read = bounded(stream, limit).map_err(|source| ReadError::Io {
        path: path(),
        source,
    })?;
    let bytes = read.ok_or_else(too_large)?;
    if !bytes.starts_with(GZIP) {
        return Ok(bytes);
    }
    let unpacked = unpacked(&bytes, limit).map_err(|source| ReadError::Packed {
        path: path(),
        source,
    })?;
    let unpacked = unpacked.ok_or_else(too_large)?;
    match unpacked.starts_with(GZIP) {
        true => Err(ReadError::PackedTwice { path: path() }),
        false => Ok(unpacked),
    }
}

/// What is packed with gzip, member after member; none where it is more than the limit. Zeros after the last member,
/// which fill the blocks of a tape, are no member.
fn unpacked(mut packed: &[u8], limit: u64) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    while packed.iter().any(|&byte| byte != 0) {
        let mut member = GzDecoder::new(packed);
        let room = limit.saturating_add(1) - bytes.len() as u64;
        member.by_ref().take(room).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > limit {
            return Ok(None);
        }
        packed = member.into_inner();
    }
    Ok(Some(bytes))
}

/// All bytes; none where there are more than the limit.
fn bounded(stream: impl Read, limit: u64) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    stream
        .take(limit.saturating_add(1))
        .read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= limit).then_some(bytes))
}

/// The extension that tells a format: that before `.gz`, if it has one.
pub(super) fn extension(path: &Path) -> Option<&str> {
    let is_packed = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("gz"));
    let unpacked = if is_packed {
        Path::new(path.file_stem()?)
    } else {
        path
    };
    unpacked.extension()?.to_str()
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    fn packed(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    fn read(bytes: &[u8], limit: u64) -> Result<Vec<u8>, ReadError> {
        read_stream(bytes, Path::new("a"), limit)
    }

    #[test]
    fn all_is_read_up_to_the_limit_and_nothing_beyond() {
        assert_eq!(read(b"1 2 3", 5).unwrap(), b"1 2 3");
        assert!(matches!(
            read(b"1 2 3", 4),
            Err(ReadError::TooLarge { limit: 4, .. })
        ));
        let endless = read_stream(io::repeat(0), Path::new("a"), 1 << 20);
        assert!(matches!(endless, Err(ReadError::TooLarge { .. })));
    }

    #[test]
    fn gzip_is_unpacked_member_after_member_and_bombs_are_refused() {
        let two = [packed(b"1 2"), packed(b" 3")].concat();
        assert_eq!(read(&two, 1000).unwrap(), b"1 2 3");
        let bomb = packed(&vec![0; 1 << 20]);
        assert!(bomb.len() < 1 << 12);
        assert!(matches!(
            read(&bomb, 1 << 12),
            Err(ReadError::TooLarge { .. })
        ));
    }

    #[test]
    fn what_is_packed_twice_is_told() {
        let refused = read(&packed(&packed(b"1 2 3")), 1000);
        assert!(matches!(refused, Err(ReadError::PackedTwice { .. })));
    }

    #[test]
    fn zeros_after_the_last_member_are_no_damage_but_all_else_is() {
        let padded = [packed(b"1 2 3"), vec![0; 512]].concat();
        assert_eq!(read(&padded, 1000).unwrap(), b"1 2 3");
        for tail in [&b"rest"[..], b"\0\0rest"] {
            let spoilt = [&packed(b"1 2 3"), tail].concat();
            let refused = read(&spoilt, 1000);
            assert!(matches!(refused, Err(ReadError::Packed { .. })), "{tail:?}");
        }
    }

    #[test]
    fn a_damaged_archive_is_named_as_such() {
        let whole = packed(b"1 2 3");
        let short = read(&whole[..whole.len() - 3], 1000);
        assert!(matches!(short, Err(ReadError::Packed { .. })));
    }

    #[test]
    fn the_extension_before_gz_tells_the_format() {
        for (name, expected) in [
            ("a.ply", Some("ply")),
            ("a.PLY.GZ", Some("PLY")),
            ("a.gz", None),
            ("a", None),
        ] {
            assert_eq!(extension(Path::new(name)), expected, "{name}");
        }
    }
}
