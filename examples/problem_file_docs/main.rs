//! Writes the tables of docs/problem-file.md anew, from the schema of problem files:
//! `cargo run --example problem_file_docs`.

mod markdown;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/problem-file.md");
    let text = std::fs::read_to_string(path)?;
    std::fs::write(path, markdown::renewed(&text)?)?;
    Ok(())
}
