//! Figures as PNG, with letters of an embedded font: it looks the same on every machine.

use std::sync::{Arc, LazyLock};

use png::{BitDepth, ColorType, DeflateCompression, Encoder, Filter};
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

/// Open Sans, under the SIL Open Font License in the same folder.
const FONTS: [&[u8]; 2] = [
    include_bytes!("../font/OpenSans-Regular.ttf"),
    include_bytes!("../font/OpenSans-SemiBold.ttf"),
];

static DATABASE: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    for font in FONTS {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family("Open Sans");
    Arc::new(fonts)
});

/// Turns an SVG into a PNG of the same size, or says why not.
pub fn png(svg: &str) -> Result<Vec<u8>, String> {
    let options = Options {
        fontdb: Arc::clone(&DATABASE),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|fault| fault.to_string())?;
    let size = tree.size().to_int_size();
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or("the figure has no size")?;
    pixels.fill(Color::WHITE);
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    let colours = pixels.pixels().iter();
    let colours = colours.map(|it| [it.red(), it.green(), it.blue()]);
    of_pixels(&colours.collect::<Vec<_>>(), size.width())
}

/// The PNG of pixels, row by row, or why there is none.
pub(super) fn of_pixels(pixels: &[[u8; 3]], width: u32) -> Result<Vec<u8>, String> {
    let height = pixels.len() / width.max(1) as usize;
    let height = u32::try_from(height).map_err(|fault| fault.to_string())?;
    encoded(pixels.as_flattened(), (width, height)).map_err(|fault| fault.to_string())
}

fn encoded(bytes: &[u8], (width, height): (u32, u32)) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    // Figures are lines on even colours, which filters make no smaller; more effort takes as long as the page.
    encoder.set_filter(Filter::NoFilter);
    encoder.set_deflate_compression(DeflateCompression::Level(3));
    encoder.write_header()?.write_image_data(bytes)?;
    Ok(file)
}
