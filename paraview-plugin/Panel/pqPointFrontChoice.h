#pragma once

#include "pqPropertyWidget.h"

#include <QString>

class QComboBox;

/// A text property with a list of usual values, of which one is chosen or another is typed.
/// ParaView 5.11's own widget of such properties takes nothing but the list.
/// XML     panel_widget="pointfront_choice" on the property; the list is its StringListDomain.
/// Typing  counts when it ends: by Return, or where the line loses the focus.
class pqPointFrontChoice : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QString value READ value WRITE setValue NOTIFY valueChanged)

public:
  pqPointFrontChoice(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqPointFrontChoice() override;

  /// The value that was chosen or typed last, without blanks around it.
  QString value() const;
  void setValue(const QString& value);

Q_SIGNALS:
  void valueChanged();

private Q_SLOTS:
  void take();

private:
  Q_DISABLE_COPY(pqPointFrontChoice)

  QComboBox* List;
  QString Value;
};
