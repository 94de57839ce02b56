//! A number that is typed while something is dragged.

/// Digits typed so far.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Typed {
    digits: String,
    negative: bool,
}

/// Longer numbers than this mean nothing to a pose.
const LONGEST: usize = 8;

impl Typed {
    /// Takes a digit, a decimal point or comma, or a minus, which turns the sign round wherever it is typed. Says
    /// whether it could be used.
    pub fn push(&mut self, letter: char) -> bool {
        match letter {
            '0'..='9' if self.digits.len() < LONGEST => self.digits.push(letter),
            '.' | ',' if !self.digits.contains('.') => self.digits.push('.'),
            '-' | '−' => self.negative = !self.negative,
            _ => return false,
        }
        true
    }

    /// Takes back what was typed last. Says whether there was anything.
    pub fn backspace(&mut self) -> bool {
        self.digits.pop().is_some() || std::mem::take(&mut self.negative)
    }

    /// Whether nothing is typed.
    pub fn is_empty(&self) -> bool {
        self.digits.is_empty() && !self.negative
    }

    /// The number; `None` before the first digit.
    pub fn value(&self) -> Option<f64> {
        let size: f64 = self.digits.parse().ok().filter(|v: &f64| v.is_finite())?;
        Some(if self.negative { -size } else { size })
    }

    /// As it was typed: `-12.5`.
    pub fn text(&self) -> String {
        format!("{}{}", if self.negative { "-" } else { "" }, self.digits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn typed(letters: &str) -> Typed {
        let mut typed = Typed::default();
        for letter in letters.chars() {
            typed.push(letter);
        }
        typed
    }

    #[test]
    fn digits_make_a_number_and_minus_turns_it_round() {
        assert_eq!(typed("12.5").value(), Some(12.5));
        assert_eq!(typed("12,5-").value(), Some(-12.5));
        assert_eq!(typed("-3-").value(), Some(3.0));
        assert_eq!(typed("1.2.3x").text(), "1.23");
        assert_eq!(typed("99999999999").text().len(), LONGEST);
        assert_eq!(typed("-").value(), None);
        assert_eq!(typed(".").value(), None);
    }

    #[test]
    fn backspace_takes_one_back_and_the_sign_last() {
        let mut typed = typed("-4");
        assert!(typed.backspace() && typed.backspace() && !typed.backspace());
        assert!(typed.is_empty());
    }
}
