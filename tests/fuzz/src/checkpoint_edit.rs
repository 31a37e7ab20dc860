//! Changes of the file of a checkpoint: as disks and people make them, and as a forger does.

use serde_json::Value;
use sha2::{Digest, Sha256};

use super::bytes::Bytes;
use super::record_edit::edit;

const MOST_EDITS: usize = 12;

/// A file in which bytes and lines were lost, changed, repeated or moved.
pub fn damage(file: &[u8], bytes: &mut Bytes<'_>) -> Vec<u8> {
    let mut file = file.to_vec();
    for _ in 0..MOST_EDITS {
        if bytes.is_empty() {
            break;
        }
        if bytes.yes() {
            change_bytes(&mut file, bytes);
        } else {
            change_lines(&mut file, bytes);
        }
    }
    file
}

fn change_bytes(file: &mut Vec<u8>, bytes: &mut Bytes<'_>) {
    let at = usize::from(bytes.short()) % (file.len() + 1);
    match bytes.byte() % 4 {
        0 => file.truncate(at),
        1 => file.insert(at, bytes.byte()),
        2 => {
            let end = file.len().min(at + bytes.count(200));
            file.drain(at..end);
        }
        _ => {
            if let Some(byte) = file.get_mut(at) {
                *byte ^= bytes.byte();
            }
        }
    }
}

fn change_lines(file: &mut Vec<u8>, bytes: &mut Bytes<'_>) {
    let mut lines: Vec<&[u8]> = file.split_inclusive(|&byte| byte == b'\n').collect();
    if lines.is_empty() {
        return;
    }
    let [one, other] = [0; 2].map(|_| usize::from(bytes.short()) % lines.len());
    match bytes.byte() % 4 {
        0 => drop(lines.remove(one)),
        1 => lines.insert(one, lines[other]),
        2 => lines.swap(one, other),
        _ => lines[one] = lines[other],
    }
    *file = lines.concat();
}

/// A file in which work came to something else, with checksums that are right.
pub fn forge(file: &[u8], bytes: &mut Bytes<'_>) -> Vec<u8> {
    let file = String::from_utf8_lossy(file);
    let mut lines: Vec<String> = file.lines().map(str::to_owned).collect();
    // Many at once, as a search looks at few poses twice.
    let every = 1 + bytes.count(40);
    let first = 1 + bytes.count(40);
    let changes = bytes.0;
    for line in lines.iter_mut().skip(first).step_by(every) {
        let [_, key, value] = line.splitn(3, ' ').collect::<Vec<_>>()[..] else {
            panic!("{line} is not work");
        };
        let mut value: Value = serde_json::from_str(value).expect("values are JSON");
        edit(&mut value, &mut Bytes(changes));
        *line = signed(&format!("{key} {value}"));
    }
    lines.join("\n").into_bytes()
}

fn signed(work: &str) -> String {
    let digest = Sha256::digest(work);
    let digits: String = digest[..8]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    format!("{digits} {work}")
}
