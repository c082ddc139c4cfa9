//! `grainform completions` and `grainform man`: what a shell and a manual know of the command line.

use super::args::{Cli, CompletionsArgs, ManArgs};
use anyhow::{Result, anyhow};
use clap::CommandFactory;
use clap_mangen::Man;
use std::io::{self, Write};

pub(super) fn completions(args: &CompletionsArgs) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "grainform", &mut script);
    Ok(io::stdout().lock().write_all(&script)?)
}

pub(super) fn man(args: &ManArgs) -> Result<()> {
    let mut all = Cli::command().disable_help_subcommand(true);
    all.build();
    let command = match &args.command {
        None => all,
        Some(name) => {
            let found = all.find_subcommand(name);
            let found =
                found.ok_or_else(|| anyhow!("there is no command {name}; see grainform --help"))?;
            found.clone().display_name(format!("grainform-{name}"))
        }
    };
    let mut page = Vec::new();
    Man::new(command).render(&mut page)?;
    Ok(io::stdout().lock().write_all(&page)?)
}
