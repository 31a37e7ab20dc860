//! Where the triangles of a binary STL file stand, told from its size and its header.

use std::io::{self, BufRead, Read, Seek, SeekFrom};

use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::mending::Mending;
use super::stl::HEADER;
use crate::elementary::hypot;

/// Bytes of a triangle: its normal and corners as twelve f32, two bytes of attributes.
const RECORD: u64 = 50;
/// One line end behind the last triangle does no harm.
const LINE_END: u64 = 2;
/// Programs that do not know the number of triangles before they have written them leave these.
const UNKNOWN: [u64; 2] = [u32::MAX as u64, i32::MAX as u64];
/// Where fewer normals than this share can be normals, bytes stand between the triangles.
const SOUND: f64 = 0.9;
/// Triangles lie within the box round the others, made this many times larger.
const NEAR: f64 = 10.0;

/// How the triangles follow each other.
pub(super) struct Layout {
    pub count: u64,
    /// Whether bytes follow each triangle, as many as its attribute says.
    pub has_vendor_bytes: bool,
    /// What was put right.
    pub mending: Option<Mending>,
    /// Whether the file is cut short, unless the triangles make a closed mesh.
    pub must_close: bool,
}

/// Whether this many triangles fill this many bytes behind the header.
pub(super) fn fits(body: u64, count: u64) -> bool {
    let extra = body.checked_sub(count.saturating_mul(RECORD));
    extra.is_some_and(|extra| extra <= LINE_END)
}

/// Finds the layout of the bytes behind the header.
pub(super) fn find(
    source: &mut (impl BufRead + Seek),
    body: u64,
    promised: u64,
) -> Result<Layout, MeshFault> {
    let plain = Layout {
        count: promised,
        has_vendor_bytes: false,
        mending: None,
        must_close: false,
    };
    if fits(body, promised) {
        return Ok(plain);
    }
    let (held, rest) = (body / RECORD, body % RECORD);
    let wrong = Defect::WrongCount {
        promised,
        held,
        rest,
    }
    .at(Place::File);
    let recounted = |must_close| Layout {
        count: held,
        mending: Some(Mending::Recounted { promised, held }),
        must_close,
        ..plain
    };
    let is_whole = held > 0 && rest <= LINE_END;
    if promised == 0 || promised > held {
        return match is_whole {
            true => Ok(recounted(promised > 0 && !UNKNOWN.contains(&promised))),
            false => Err(wrong),
        };
    }
    let extra = body - promised * RECORD;
    let failed = |error: io::Error| Defect::from(error).at(Place::File);
    if vendor_bytes_fill(source, body, promised).map_err(failed)? {
        return Ok(Layout {
            has_vendor_bytes: true,
            mending: Some(Mending::VendorBytes { bytes: extra }),
            ..plain
        });
    }
    let seen = Seen::of(source, body, promised).map_err(failed)?;
    match seen {
        Seen {
            are_sound: false, ..
        } => Err(Defect::VendorData.at(Place::File)),
        Seen { goes_on: true, .. } if is_whole => Ok(recounted(false)),
        Seen { goes_on: true, .. } => Err(wrong),
        Seen { .. } => Ok(Layout {
            mending: Some(Mending::TrailingBytes { bytes: extra }),
            ..plain
        }),
    }
}

/// Whether the triangles, each with as many bytes behind it as its attribute says, fill the file.
fn vendor_bytes_fill(
    source: &mut (impl BufRead + Seek),
    body: u64,
    count: u64,
) -> io::Result<bool> {
    source.seek(SeekFrom::Start(HEADER))?;
    let mut used = 0;
    for _ in 0..count {
        if used + RECORD > body {
            return Ok(false);
        }
        let record = Record::read(source)?;
        used += RECORD + record.vendor_bytes();
        if used > body {
            return Ok(false);
        }
        record.pass_over_vendor_bytes(source)?;
    }
    Ok(body - used <= LINE_END)
}

/// What triangles side by side look like.
struct Seen {
    /// Whether the promised ones are triangles.
    are_sound: bool,
    /// Whether whole triangles follow behind these.
    goes_on: bool,
}

impl Seen {
    fn of(source: &mut (impl BufRead + Seek), body: u64, promised: u64) -> io::Result<Self> {
        source.seek(SeekFrom::Start(HEADER))?;
        let mut sound = 0;
        let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
        for _ in 0..promised {
            let record = Record::read(source)?;
            sound += u64::from(record.has_normal());
            for corner in record.corners() {
                for axis in 0..3 {
                    low[axis] = low[axis].min(corner[axis]);
                    high[axis] = high[axis].max(corner[axis]);
                }
            }
        }
        let are_sound = sound as f64 >= SOUND * promised as f64;
        let is_near = |corner: [f64; 3]| {
            (0..3).all(|axis| {
                let room = NEAR * (0..3).map(|it| high[it] - low[it]).fold(0.0, f64::max);
                (low[axis] - room..=high[axis] + room).contains(&corner[axis])
            })
        };
        let mut goes_on = body / RECORD > promised;
        for _ in promised..body / RECORD {
            let record = Record::read(source)?;
            goes_on &= !record.is_blank()
                && record.has_normal()
                && record.corners().into_iter().all(is_near);
        }
        Ok(Self { are_sound, goes_on })
    }
}

/// One triangle as it stands in the file.
pub(super) struct Record([u8; RECORD as usize]);

impl Record {
    pub fn read(source: &mut impl Read) -> io::Result<Self> {
        let mut bytes = [0; RECORD as usize];
        source.read_exact(&mut bytes)?;
        Ok(Self(bytes))
    }

    /// Corners, in the file's unit.
    pub fn corners(&self) -> [[f64; 3]; 3] {
        let [_, corners @ ..] = self.vectors();
        corners
    }

    /// Passes over the bytes that belong to the triangle, as many as its attribute says.
    pub fn pass_over_vendor_bytes(&self, source: &mut impl Read) -> io::Result<()> {
        let bytes = self.vendor_bytes();
        io::copy(&mut source.take(bytes), &mut io::sink()).map(drop)
    }

    fn vendor_bytes(&self) -> u64 {
        let [.., low, high] = self.0;
        u64::from(u16::from_le_bytes([low, high]))
    }

    /// The normal and the corners.
    fn vectors(&self) -> [[f64; 3]; 4] {
        let mut vectors = [[0.0; 3]; 4];
        let (values, _) = self.0.as_chunks::<4>();
        for (value, bytes) in vectors.iter_mut().flatten().zip(values) {
            *value = f64::from(f32::from_le_bytes(*bytes));
        }
        vectors
    }

    /// Whether what stands in the place of the normal can be one: of length 1, or left out.
    fn has_normal(&self) -> bool {
        let [[x, y, z], ..] = self.vectors();
        let length = hypot(hypot(x, y), z);
        length == 0.0 || length.is_nan() || (0.5..2.0).contains(&length)
    }

    fn is_blank(&self) -> bool {
        self.0.iter().all(|byte| *byte == 0)
    }
}
