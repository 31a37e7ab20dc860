//! placeholder until merged
#[derive(clap::Args)]
pub struct ImpactArgs {}
pub fn run(_: &ImpactArgs) -> Result<String, String> {
    Ok(String::new())
}
